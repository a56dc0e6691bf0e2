// The report's data, from the page's JSON to typed arrays. The format is described in README.md.

export class DataError extends Error {}

const known_format = 1;

/** The object in the page's JSON element; throws a DataError that says in words what is wrong. */
export function readPage(document) {
  const element = document.getElementById('weaveform-data');
  if (!element) throw new DataError('This page holds no data: the element "weaveform-data" is missing. Write the report again.');
  let data;
  try {
    data = JSON.parse(element.textContent);
  } catch (error) {
    throw new DataError(`The data of this report cannot be read (${error.message}). The file is damaged or cut off; write the report again.`);
  }
  if (data.format !== known_format) {
    throw new DataError(`This report's data has format ${data.format}, its viewer reads format ${known_format}. Write the report again.`);
  }
  return data;
}

function bytes(text, what) {
  let binary;
  try {
    binary = atob(text);
  } catch {
    throw new DataError(`${what}: not base64. The file is damaged; write the report again.`);
  }
  const result = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) result[i] = binary.charCodeAt(i);
  return result;
}

/**
 * A base64 string of little-endian numbers as a typed array of `Type`; `length` is what it must hold, when it is known.
 * Every machine that runs browsers today is little-endian.
 */
export function decode(text, Type, what, length = null) {
  const raw = bytes(text ?? '', what);
  const size = Type.BYTES_PER_ELEMENT;
  if (raw.length % size) throw new DataError(`${what}: ${raw.length} bytes are no whole number of values of ${size} bytes.`);
  const values = new Type(raw.buffer);
  if (length !== null && values.length !== length) {
    throw new DataError(`${what}: ${values.length} values where ${length} belong.`);
  }
  return values;
}

/** Positions in mm of a frame: origin + step * value. */
export function positionsOf(text, { origin, step }, node_count, what) {
  const coded = decode(text, Int16Array, what, 3 * node_count);
  const positions = new Float32Array(coded.length);
  for (let i = 0; i < coded.length; ++i) positions[i] = origin[i % 3] + step * coded[i];
  return positions;
}

const no_value = 65535;

/** Values of a field in its unit; NaN where there is none. */
export function valuesOf(text, { from, to }, count, what) {
  const coded = decode(text, Uint16Array, what, count);
  const values = new Float32Array(count);
  for (let i = 0; i < count; ++i) values[i] = coded[i] === no_value ? NaN : from + ((to - from) * coded[i]) / (no_value - 1);
  return values;
}

/** The indices in `indices` must be below `count`. */
export function checkIndices(indices, count, what) {
  for (const index of indices) {
    if (index >= count) throw new DataError(`${what}: index ${index} where there are ${count}.`);
  }
}
