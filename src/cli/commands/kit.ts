/** `marrow kit`: small files that tell known mistakes apart, with the right numbers. */
import { existsSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { testKit } from '../../teaching/kit/kit.ts';
import { oneFolder } from '../options/inputs.ts';
import { flag } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { printJson } from '../report.ts';
import { writeInFolder } from '../write-output.ts';

export const kit = shellCommand({
  name: 'kit',
  summary: 'Writes small test files that reveal known mistakes, with the right answers, to a folder.',
  inputs: oneFolder('OUT', 'folder to write to', 'The folder for the files, created if missing.'),
  options: {
    force: flag('Overwrites existing files of the kit.'),
    json: flag('Prints the names of the written files as JSON.'),
  },
  examples: ['marrow kit kit/'],
  exits: {
    0: 'all files were written',
    1: 'a file of the kit already exists',
    2: 'wrong usage',
    3: 'a file could not be written',
  },
  async run({ inputs: out, options: { force, json } }, io) {
    const folder = resolve(io.folder, out);
    const files = testKit();
    const there = [...files.keys()].filter((name) => existsSync(join(folder, name)));
    if (there.length > 0 && !force) {
      io.err(
        `marrow: ${there.join(', ')} in ${out} ${there.length === 1 ? 'exists' : 'exist'}; use --force to overwrite.\n`,
      );
      return 1;
    }
    const failure = writeAll(folder, files);
    if (failure !== undefined) {
      io.err(`marrow: ${failure}.\n`);
      return 3;
    }
    if (json) await printJson({ written: [...files.keys()].map((name) => `${out}/${name}`) }, io);
    else await io.out(`${[...files.keys()].map((name) => `${out}/${name}\n`).join('')}`);
    return 0;
  },
});

/** @returns why a file could not be written */
function writeAll(folder: string, files: ReadonlyMap<string, string>): string | undefined {
  for (const [name, text] of files) {
    const written = writeInFolder(join(folder, name), [text]);
    if ('failure' in written) return `${name} could not be written: ${written.failure}`;
  }
  return undefined;
}
