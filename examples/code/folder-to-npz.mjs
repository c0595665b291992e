// The captures of a folder as arrays for numpy, at 30 frames per second: node folder-to-npz.mjs captures arrays
import { mkdir, readdir, readFile, writeFile } from 'node:fs/promises';
import { join, parse } from 'node:path';
import { takeArrays, writeNpz } from 'marrow/dataset';
import { readCharacters } from 'marrow/import';

const [from, to] = process.argv.slice(2);
await mkdir(to, { recursive: true });
for (const name of (await readdir(from)).sort()) {
  if (!name.endsWith('.bvh')) continue;
  const { characters } = await readCharacters([{ name, content: await readFile(join(from, name)) }]);
  for (const character of characters) {
    try {
      const arrays = takeArrays(character, { fps: 30 });
      await writeFile(join(to, `${parse(name).name}.npz`), writeNpz(arrays, { input: name }));
      console.log(`${name}: ${arrays.frameCount} frames of ${arrays.names.length} joints`);
    } catch (error) {
      console.error(`${name}: ${error.message}`); // A sentence, such as that it has no motion.
    }
  }
}
