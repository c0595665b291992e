// Motion capture for game engines and the web: node bvh-to-glb.mjs walk.bvh walk.glb
import { readFile, writeFile } from 'node:fs/promises';
import { writeGlb } from 'marrow/export';
import { readCharacters } from 'marrow/import';

const [from, to] = process.argv.slice(2);
// As the page opens it: unit, up axis and ground are found out.
const { characters, diagnostics } = await readCharacters([{ name: from, content: await readFile(from) }]);
for (const { severity, line, message } of diagnostics) console.error(`${severity}, line ${line}: ${message}`);
if (characters.length === 0) process.exit(1);

const { bytes, report } = writeGlb(characters[0]);
await writeFile(to, bytes);
console.log(`${report.joints} joints, ${report.takes.length} take, ${bytes.length} bytes`);
