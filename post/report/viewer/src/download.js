// Files made on the page and given to the browser to save.
import { h } from './elements.js';

function save(url, name) {
  h('a', { href: url, download: name }).click();
}

export function saveText(text, type, name) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  save(url, name);
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/** An SVG as a picture of twice its pixels. */
export function savePngOfSvg(svg, [width, height], name) {
  const image = new Image();
  image.onload = () => {
    const canvas = h('canvas', { width: 2 * width, height: 2 * height });
    canvas.getContext('2d').drawImage(image, 0, 0, 2 * width, 2 * height);
    save(canvas.toDataURL('image/png'), name);
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
}
