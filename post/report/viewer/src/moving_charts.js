// ECharts with what a page adds to what is drawn: hovering and zooming.
import { DataZoomInsideComponent, TooltipComponent } from 'echarts/components';
import { init, use } from '../../../../core/chart/echarts/echarts_parts.js';

use([DataZoomInsideComponent, TooltipComponent]);

export { init };
