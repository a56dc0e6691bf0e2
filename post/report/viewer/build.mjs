// Packs src/ and the parts of vtk.js and ECharts that it uses into packed/, and the script that draws charts
// (core/chart/echarts) into its packed/, each with the licences of all that went in. Every byte depends on the sources and
// the lock file alone.
import { build } from 'esbuild';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';

const drawing = '../../../core/chart/echarts';
const shared = {
  bundle: true, minify: true, charset: 'utf8', legalComments: 'none', metafile: true, logLevel: 'warning',
  define: { 'process.env.NODE_ENV': '"production"' },
  nodePaths: ['node_modules'], // for the sources outside of this folder
};

// The packages that have at least a byte in the script.
function packagesIn(metafile) {
  const names = new Set();
  for (const output of Object.values(metafile.outputs)) {
    for (const [path, { bytesInOutput }] of Object.entries(output.inputs)) {
      const match = bytesInOutput > 0 && path.match(/.*node_modules\/((?:@[^/]+\/)?[^/]+)\//);
      if (match) names.add(match[1]);
    }
  }
  return [...names].sort();
}

const licence_files = /^(licen[cs]e|copying|copyright|notice)/i;

// Some have it at the end of their README only.
function licenceInReadme(folder) {
  const text = readFileSync(join(folder, 'README.md'), 'utf8');
  const at = text.search(/^(#+ )?licen[cs]e\b/im);
  return at < 0 ? [] : [text.slice(at).trim()];
}

function licenceOf(name) {
  const folder = join('node_modules', name);
  const about = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const files = readdirSync(folder)
    .filter((file) => licence_files.test(file) && statSync(join(folder, file)).isFile())
    .sort()
    .map((file) => readFileSync(join(folder, file), 'utf8').trim());
  const nested = join(folder, 'licenses'); // of what the package itself took in
  if (existsSync(nested)) files.push(...readdirSync(nested).sort().map((file) => readFileSync(join(nested, file), 'utf8').trim()));
  const texts = files.length ? files : licenceInReadme(folder);
  if (!texts.length) throw new Error(`${name} ${about.version} has no licence file; name its licence in build.mjs`);
  return `${name} ${about.version} (${about.license})\n${'='.repeat(60)}\n\n${texts.join('\n\n')}\n`;
}

// Beside the script, and as its last comment: who passes a report or the program on passes the packages on, and has to
// pass their licences on with them.
function addLicences(script, metafile) {
  const name = script.split('/').pop();
  const licences =
    `${name} holds parts of these packages, each under its own licence; the rest of it is Weaveform.\n\n\n` +
    packagesIn(metafile).map(licenceOf).join('\n\n');
  writeFileSync(join(script, '..', 'LICENSES.txt'), licences);
  const comment = licences.replaceAll('*/', '* /').replaceAll('</', '< /').replaceAll('<!--', '< !--');
  writeFileSync(script, `${readFileSync(script, 'utf8').trimEnd()}\n/*\n${comment}*/\n`);
}

const filesIn = (folder) => readdirSync(folder, { recursive: true }).map((file) => join(folder, file)).filter((file) => statSync(file).isFile());
const drawing_sources = filesIn(drawing).filter((file) => file.endsWith('.js') && !file.includes('packed'));
const recipe = ['build.mjs', 'package-lock.json'];

// What a folder was packed from, so that a test can tell, without npm, when sources changed after packing.
function noteSources(packed, sources) {
  const digest = (file) => createHash('sha256').update(readFileSync(file)).digest('hex');
  writeFileSync(join(packed, 'SOURCES'), sources.sort().map((file) => `${digest(file)}  ${relative(join(packed, '..'), file)}\n`).join(''));
}

for (const packed of ['packed', join(drawing, 'packed')]) mkdirSync(packed, { recursive: true });

const viewer = await build({
  ...shared,
  entryPoints: ['src/main.js'],
  outfile: 'packed/report.js',
  format: 'iife',
  target: ['es2020'],
  supported: { 'inline-script': true }, // "</script" inside a string would end the page's script
  alias: {
    // vtk.js's window asks for these; a report has neither a WebGPU path nor XML files to read
    xmlbuilder2: './src/nothing.js',
  },
});
await build({ ...shared, entryPoints: ['src/report.css'], outfile: 'packed/report.css' });
addLicences('packed/report.js', viewer.metafile);
noteSources('packed', [...recipe, ...filesIn('src'), ...drawing_sources]);

const drawer = await build({
  ...shared,
  entryPoints: [join(drawing, 'draw_charts.js')],
  outfile: join(drawing, 'packed/draw_charts.js'),
  format: 'cjs',
  platform: 'node',
  target: ['node18'], // Debian 12's
});
addLicences(join(drawing, 'packed/draw_charts.js'), drawer.metafile);
noteSources(join(drawing, 'packed'), [...recipe, ...drawing_sources]);
