// Of ECharts only what is drawn: lines, points, bars, bands, on plain axes, as SVG.
import { BarChart, CustomChart, LineChart, ScatterChart } from 'echarts/charts';
import { GridComponent, LegendPlainComponent, MarkLineComponent, TitleComponent } from 'echarts/components';
import { use } from 'echarts/core';
import { LabelLayout } from 'echarts/features';
import { SVGRenderer } from 'echarts/renderers';

use([BarChart, CustomChart, LineChart, ScatterChart, GridComponent, LegendPlainComponent, MarkLineComponent, TitleComponent, LabelLayout, SVGRenderer]);

export { init, setPlatformAPI, use } from 'echarts/core';
