/**
 * Writes the examples into a folder: `public/samples` of the current folder, or the one given.
 *
 *     npm run examples                (the files are in the repository: run this after changing their sources)
 */
import { mkdirSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { sampleFolder } from './examples.ts';

/** Returns the files' names and sizes in bytes. Other files in the folder are left alone. */
function writeSamples(folder: string): Map<string, number> {
  mkdirSync(folder, { recursive: true });
  const sizes = new Map<string, number>();
  for (const [name, content] of sampleFolder()) {
    const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : content;
    writeFileSync(join(folder, name), bytes);
    sizes.set(name, bytes.length);
  }
  return sizes;
}

const invoked = process.argv[1];
if (invoked && import.meta.url === pathToFileURL(resolve(invoked)).href) {
  const sizes = writeSamples(process.argv[2] ?? 'public/samples');
  for (const [name, bytes] of sizes) console.log(`${String(bytes).padStart(8)}  ${name}`);
  console.log(`${String([...sizes.values()].reduce((a, b) => a + b, 0)).padStart(8)}  in all`);
}
