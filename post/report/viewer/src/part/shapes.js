// What is drawn, as vtk.js actors: coloured surfaces, lines, points.
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkCellArray from '@kitware/vtk.js/Common/Core/CellArray';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';

function makeActor() {
  const data = vtkPolyData.newInstance();
  const mapper = vtkMapper.newInstance();
  mapper.setColorModeToDirectScalars(); // bytes are colours, not values to be coloured
  mapper.setInputData(data);
  // lines that lie on the surface win over it
  mapper.setResolveCoincidentTopology(1);
  mapper.setRelativeCoincidentTopologyLineOffsetParameters(-1, -4);
  mapper.setRelativeCoincidentTopologyPolygonOffsetParameters(1, 1);
  const actor = vtkActor.newInstance();
  actor.setMapper(mapper);
  return { actor, mapper, data };
}

const cellArray = (values) => vtkCellArray.newInstance({ values });

function setPoints(data, positions) {
  data.getPoints().setData(positions, 3);
  data.getPoints().modified();
  data.modified();
}

/** Lists of polygons as vtk has them, [count, node, ...], of the `shown` cells. */
export function polygonsOf(cells, shown) {
  const list = [];
  for (const cell of shown) {
    const [a, b, c, d] = cells.subarray(4 * cell, 4 * cell + 4);
    if (d === c) list.push(3, a, b, c);
    else list.push(4, a, b, c, d);
  }
  return Uint32Array.from(list);
}

/** [3, a, b, c, ...] from [a, b, c, ...]; likewise pairs with corners = 2. */
export function counted(indices, corners) {
  const count = Math.floor(indices.length / corners);
  const list = new Uint32Array(count * (corners + 1));
  for (let i = 0; i < count; ++i) {
    list[i * (corners + 1)] = corners;
    for (let k = 0; k < corners; ++k) list[i * (corners + 1) + 1 + k] = indices[i * corners + k];
  }
  return list;
}

/** A surface whose colours are given per polygon or per point. */
export function makeSurface() {
  const { actor, mapper, data } = makeActor();
  const property = actor.getProperty();
  property.setInterpolationToPhong();
  property.setAmbient(0.62); // enough that colours on slopes still match the bar's
  property.setDiffuse(0.42);
  property.setSpecular(0);
  return {
    actor,
    setPolygons(list) {
      data.setPolys(cellArray(list));
    },
    setPositions(positions, normals) {
      setPoints(data, positions);
      data.getPointData().setNormals(normals ? vtkDataArray.newInstance({ name: 'normals', values: normals, numberOfComponents: 3 }) : null);
    },
    /** `colours`: bytes r, g, b per point, or per polygon; null: one colour for all. */
    setColours(colours, { per_point }) {
      data.getPointData().setScalars(null);
      data.getCellData().setScalars(null);
      if (colours) {
        const array = vtkDataArray.newInstance({ name: 'colours', values: colours, numberOfComponents: 3 });
        (per_point ? data.getPointData() : data.getCellData()).setScalars(array);
        if (per_point) mapper.setScalarModeToUsePointData();
        else mapper.setScalarModeToUseCellData();
      }
      mapper.setScalarVisibility(Boolean(colours));
      data.modified();
    },
    setColour([r, g, b]) {
      property.setColor(r / 255, g / 255, b / 255);
    },
  };
}

/** Unlit lines of one colour. */
export function makeLines([r, g, b], width = 1) {
  const { actor, mapper, data } = makeActor();
  mapper.setScalarVisibility(false);
  const property = actor.getProperty();
  property.setLighting(false);
  property.setColor(r / 255, g / 255, b / 255);
  property.setLineWidth(width);
  return {
    actor,
    setColour([red, green, blue]) {
      property.setColor(red / 255, green / 255, blue / 255);
    },
    /** Pairs of nodes. */
    setPairs(pairs) {
      data.setLines(cellArray(counted(pairs, 2)));
    },
    setPositions(positions) {
      setPoints(data, positions);
    },
    /** Segments x, y, z, x, y, z with points of their own. */
    setSegments(points) {
      setPoints(data, points);
      data.setLines(cellArray(counted(Uint32Array.from({ length: points.length / 3 }, (_, i) => i), 2)));
    },
  };
}

/** Points with a colour each (bytes r, g, b). */
export function makePoints(positions, size) {
  const { actor, mapper, data } = makeActor();
  const count = positions.length / 3;
  setPoints(data, positions);
  data.setVerts(cellArray(counted(Uint32Array.from({ length: count }, (_, i) => i), 1)));
  actor.getProperty().setPointSize(size);
  actor.getProperty().setLighting(false);
  return {
    actor,
    setColours(colours) {
      data.getPointData().setScalars(vtkDataArray.newInstance({ name: 'colours', values: colours, numberOfComponents: 3 }));
      mapper.setScalarVisibility(true);
      data.modified();
    },
  };
}

const glass_offset = 20000; // in the smallest steps of depth: some half a millimetre of a part of 600 mm

/** A tool: glass, moved as a whole. */
export function makeGlass(positions, triangles) {
  const { actor, mapper, data } = makeActor();
  setPoints(data, positions);
  data.setPolys(cellArray(counted(triangles, 3)));
  mapper.setScalarVisibility(false);
  const property = actor.getProperty();
  // Fabric that lies on the glass, or a little in it where the tool's triangles cut the curve short, is seen whole.
  mapper.setRelativeCoincidentTopologyPolygonOffsetParameters(2, glass_offset);
  property.setColor(0.45, 0.58, 0.7);
  property.setOpacity(0.22);
  property.setAmbient(0.3);
  property.setDiffuse(0.6);
  property.setSpecular(0.3);
  property.setSpecularPower(30);
  return { actor };
}
