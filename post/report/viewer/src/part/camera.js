// Looking around: standing views, turning, moving and coming nearer by mouse, fingers and keys.

const directions = {
  // where from, and what is up
  slant: [[-0.55, -1, 0.75], [0, 0, 1]],
  top: [[0, 0, 1], [0, 1, 0]],
  front: [[0, -1, 0], [0, 0, 1]],
  side: [[1, 0, 0], [0, 0, 1]],
};

/** Directions and the size they need, of positions in the ball {centre, radius}. */
export const view_names = Object.keys(directions);

const unit = (v) => v.map((x) => x / Math.hypot(...v));
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const along = (a, s, b) => a.map((x, i) => x + s * b[i]);

/** {right, up, back} of the camera, unit vectors. */
export function axesOf(camera) {
  const back = unit(along(camera.getPosition(), -1, camera.getFocalPoint()));
  const right = unit(cross(camera.getViewUp(), back));
  return { right, up: cross(back, right), back };
}

/** The ray through a point of the viewport; x to the right and y up, each −1..1 over a viewport of this width : height. */
export function rayThrough(camera, x, y, aspect) {
  const { right, up, back } = axesOf(camera);
  const half = Math.tan((camera.getViewAngle() * Math.PI) / 360);
  const direction = back.map((b, i) => -b + half * (x * aspect * right[i] + y * up[i]));
  return { origin: camera.getPosition(), direction };
}

/** The inverse: where a point is seen, x and y in −1..1 when it is in view; null behind the camera. */
export function seenAt(camera, point, aspect) {
  const { right, up, back } = axesOf(camera);
  const from = along(point, -1, camera.getPosition());
  const depth = -dot(from, back);
  if (depth <= 0) return null;
  const half = Math.tan((camera.getViewAngle() * Math.PI) / 360);
  return [dot(from, right) / (depth * half * aspect), dot(from, up) / (depth * half)];
}

/** Puts the camera into a standing view, or with name null leaves its direction, so that all points are in the picture. */
export function fit(camera, name, points, aspect) {
  if (name) {
    const [from, up] = directions[name];
    camera.setFocalPoint(0, 0, 0);
    camera.setPosition(...unit(from));
    camera.setViewUp(...up);
  }
  const { right, up, back } = axesOf(camera);
  const half_height = Math.tan((camera.getViewAngle() * Math.PI) / 360) * 0.92; // a little air
  const half_width = half_height * aspect;
  // The camera at  focus + distance * back  sees a point with  |x − x0| <= half_width * (distance − depth): each side of
  // the picture is a half-space, so the extremes of  x + half_width * depth  and the like decide.
  const greatest = { r: -Infinity, l: -Infinity, t: -Infinity, b: -Infinity };
  let depth = -Infinity;
  for (let i = 0; i < points.length; i += 3) {
    const p = points.subarray(i, i + 3);
    const [x, y, z] = [dot(p, right), dot(p, up), dot(p, back)];
    greatest.r = Math.max(greatest.r, x + half_width * z);
    greatest.l = Math.max(greatest.l, -x + half_width * z);
    greatest.t = Math.max(greatest.t, y + half_height * z);
    greatest.b = Math.max(greatest.b, -y + half_height * z);
    depth = Math.max(depth, z);
  }
  const x0 = (greatest.r - greatest.l) / 2;
  const y0 = (greatest.t - greatest.b) / 2;
  const distance = Math.max((greatest.r + greatest.l) / (2 * half_width), (greatest.t + greatest.b) / (2 * half_height), depth + 1e-6);
  return { x0, y0, distance, right, up, back };
}

/** fit, and the camera set; it turns about `centre`'s depth. */
export function look(camera, name, points, aspect, centre) {
  const { x0, y0, distance, right, up, back } = fit(camera, name, points, aspect);
  const depth = dot(centre, back);
  const at = (d) => right.map((r, i) => x0 * r + y0 * up[i] + d * back[i]);
  camera.setFocalPoint(...at(depth));
  camera.setPosition(...at(distance));
  camera.setViewUp(...up);
}

/** Turns about the focal point: radians to the right and up. */
export function turn(camera, to_right, to_up) {
  camera.azimuth((-to_right * 180) / Math.PI);
  camera.elevation((to_up * 180) / Math.PI);
  camera.orthogonalizeViewUp();
}

/** Moves the picture by parts of its height. */
export function move(camera, to_right, to_up) {
  const { right, up } = axesOf(camera);
  const size = 2 * camera.getDistance() * Math.tan((camera.getViewAngle() * Math.PI) / 360);
  const shift = right.map((r, i) => -size * (to_right * r + to_up * up[i]));
  camera.setPosition(...along(camera.getPosition(), 1, shift));
  camera.setFocalPoint(...along(camera.getFocalPoint(), 1, shift));
}

/** Comes nearer by a factor above 1, goes away by one below. */
export function nearer(camera, factor) {
  const back = along(camera.getPosition(), -1, camera.getFocalPoint());
  camera.setPosition(...along(camera.getFocalPoint(), 1 / factor, back));
}

/**
 * Mouse: drag turns, with shift or the middle or right button moves, the wheel comes nearer once the picture was clicked
 * or focused (before that it scrolls the page). Fingers: one turns, two move and pinch. Keys: arrows turn, with shift
 * move, + and − come nearer. `changed` is called after each; `clicked(x, y)` with client coordinates of a press that did
 * not move.
 */
export function watch(element, camera, { changed, clicked }) {
  const pressed = new Map(); // pointer id: [x, y]
  let travelled = 0;
  let moves = false;
  const height = () => element.clientHeight || 1;

  element.addEventListener('pointerdown', (event) => {
    element.focus({ preventScroll: true });
    element.setPointerCapture(event.pointerId);
    pressed.set(event.pointerId, [event.clientX, event.clientY]);
    moves = event.shiftKey || event.button > 0;
    if (pressed.size === 1) travelled = 0;
  });
  element.addEventListener('pointermove', (event) => {
    const last = pressed.get(event.pointerId);
    if (!last) return;
    const [dx, dy] = [event.clientX - last[0], event.clientY - last[1]];
    travelled += Math.hypot(dx, dy);
    if (pressed.size === 2) {
      const other = [...pressed].find(([id]) => id !== event.pointerId)[1];
      const before = Math.hypot(last[0] - other[0], last[1] - other[1]) || 1;
      nearer(camera, Math.hypot(event.clientX - other[0], event.clientY - other[1]) / before || 1);
      move(camera, dx / 2 / height(), -dy / 2 / height());
    } else if (moves) move(camera, dx / height(), -dy / height());
    else turn(camera, (Math.PI * dx) / height(), (Math.PI * dy) / height());
    pressed.set(event.pointerId, [event.clientX, event.clientY]);
    changed();
  });
  const release = (event) => {
    if (!pressed.delete(event.pointerId)) return;
    if (event.type === 'pointerup' && event.button === 0 && travelled < 4) clicked(event.clientX, event.clientY);
  };
  element.addEventListener('pointerup', release);
  element.addEventListener('pointercancel', release);
  element.addEventListener('contextmenu', (event) => event.preventDefault());
  element.addEventListener(
    'wheel',
    (event) => {
      if (document.activeElement !== element) return;
      event.preventDefault();
      nearer(camera, Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)));
      changed();
    },
    { passive: false },
  );
  element.addEventListener('keydown', (event) => {
    const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [0, 0];
    if (dx || dy) event.shiftKey ? move(camera, dx * 0.05, dy * 0.05) : turn(camera, dx * 0.1, -dy * 0.1);
    else if (event.key === '+' || event.key === '=') nearer(camera, 1.15);
    else if (event.key === '-') nearer(camera, 1 / 1.15);
    else return;
    event.preventDefault();
    changed();
  });
}
