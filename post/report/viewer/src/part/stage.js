// The picture's stage: a canvas with one or two viewports that look through the same camera.
import '@kitware/vtk.js/Rendering/OpenGL/Texture';
import '@kitware/vtk.js/Rendering/OpenGL/Actor';
import '@kitware/vtk.js/Rendering/OpenGL/Camera';
import '@kitware/vtk.js/Rendering/OpenGL/PolyDataMapper';
import '@kitware/vtk.js/Rendering/OpenGL/Renderer';
import vtkCamera from '@kitware/vtk.js/Rendering/Core/Camera';
import vtkOpenGLRenderWindow from '@kitware/vtk.js/Rendering/OpenGL/RenderWindow';
import vtkRenderer from '@kitware/vtk.js/Rendering/Core/Renderer';
import vtkRenderWindow from '@kitware/vtk.js/Rendering/Core/RenderWindow';

/** True where the browser can draw: vtk.js needs WebGL 2. */
export function canDraw() {
  try {
    const context = document.createElement('canvas').getContext('webgl2');
    context?.getExtension('WEBGL_lose_context')?.loseContext();
    return Boolean(context);
  } catch {
    return false;
  }
}

/**
 * A stage in `container` with `count` viewports side by side. add(actor, viewport) puts an actor on it; render() draws at
 * once, ask() before the next frame of the screen.
 */
export function makeStage(container, count) {
  const window_node = vtkRenderWindow.newInstance();
  const view = vtkOpenGLRenderWindow.newInstance();
  view.setContainer(container);
  window_node.addView(view);
  const camera = vtkCamera.newInstance();
  camera.setViewAngle(25);
  const renderers = Array.from({ length: count }, (_, i) => {
    const renderer = vtkRenderer.newInstance({ background: [1, 1, 1] });
    renderer.setViewport(i / count, 0, (i + 1) / count, 1);
    window_node.addRenderer(renderer);
    renderer.setActiveCamera(camera);
    renderer.setTwoSidedLighting(true);
    return renderer;
  });
  const canvas = view.getCanvas();
  let asked = false;

  function render() {
    asked = false;
    renderers.forEach((renderer) => renderer.updateLightsGeometryToFollowCamera());
    window_node.render();
    stage.drawn.forEach((react) => react());
  }

  const stage = {
    canvas,
    camera,
    count,
    drawn: [], // called after each picture
    add: (actor, viewport = 0) => renderers[viewport].addActor(actor),
    remove: (actor, viewport = 0) => renderers[viewport].removeActor(actor),
    render,
    ask() {
      if (asked) return;
      asked = true;
      requestAnimationFrame(() => asked && render());
    },
    /** Width and height of one viewport in CSS pixels. */
    size: () => [container.clientWidth / count, container.clientHeight],
    resize() {
      const scale = window.devicePixelRatio || 1;
      view.setSize(Math.max(1, Math.round(container.clientWidth * scale)), Math.max(1, Math.round(container.clientHeight * scale)));
      stage.ask();
    },
    /** The picture as a PNG's data URL. */
    picture() {
      render();
      return canvas.toDataURL('image/png');
    },
    /** Nearest and farthest planes around a ball. */
    setDepth({ centre, radius }) {
      const position = camera.getPosition();
      const distance = Math.hypot(...position.map((x, i) => x - centre[i]));
      camera.setClippingRange(Math.max(distance - 1.5 * radius, radius / 200), distance + 1.5 * radius);
    },
  };
  return stage;
}
