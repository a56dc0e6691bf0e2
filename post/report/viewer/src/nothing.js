// Stands for packages that vtk.js names and a report never calls.
export const create = undefined;
export default undefined;
