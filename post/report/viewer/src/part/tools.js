// The tools as glass, where they stand at each frame.
import { checkIndices, decode } from '../data.js';
import { makeGlass } from './shapes.js';

/** From the "tools" of the data; draw({frame, tools}) moves them and shows those whose names are in the set `tools`. */
export function drawTools(stage, tools) {
  const shapes = tools.map((tool) => {
    const points = decode(tool.points, Float32Array, `points of the tool ${tool.name}`);
    const triangles = decode(tool.triangles, Uint32Array, `triangles of the tool ${tool.name}`);
    checkIndices(triangles, points.length / 3, `triangles of the tool ${tool.name}`);
    const { actor } = makeGlass(points, triangles);
    stage.add(actor);
    return { name: tool.name, actor, motion: tool.motion ?? [] };
  });
  return {
    names: shapes.map(({ name }) => name),
    draw({ frame, tools: visible }) {
      for (const { name, actor, motion } of shapes) {
        actor.setVisibility(visible.has(name));
        actor.setPosition(...(motion[frame] ?? motion[motion.length - 1] ?? [0, 0, 0]));
      }
    },
  };
}
