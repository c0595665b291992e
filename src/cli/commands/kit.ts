/** `marrow kit`: small files that tell known mistakes apart, with the right numbers. */
import { existsSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { testKit } from '../../kit/kit.ts';
import { parseArguments, UsageError } from '../arguments.ts';
import type { CliCommand } from '../io.ts';
import { printJson } from '../report.ts';
import { writeInFolder } from '../write-output.ts';

export const kit: CliCommand = {
  name: 'kit',
  usage: 'OUT [--force] [--json]',
  summary: 'writes small test files that tell known mistakes apart, with their answers, into the folder OUT',
  exits: {
    0: 'all files were written',
    1: 'a file of the kit is there already',
    2: 'wrong usage',
    3: 'a file could not be written',
  },
  async run(args, io) {
    const given = parseArguments(args, { force: 'flag', json: 'flag' });
    const [out, ...others] = given.files;
    if (out === undefined || others.length > 0) throw new UsageError('kit takes one folder to write to.');
    const folder = resolve(io.folder, out);
    const files = testKit();
    const there = [...files.keys()].filter((name) => existsSync(join(folder, name)));
    if (there.length > 0 && !given.flag('force')) {
      io.err(`marrow: ${there.join(', ')} in ${out} ${there.length === 1 ? 'exists' : 'exist'}; --force replaces.\n`);
      return 1;
    }
    const failure = writeAll(folder, files);
    if (failure !== undefined) {
      io.err(`marrow: ${failure}.\n`);
      return 3;
    }
    if (given.flag('json')) await printJson({ written: [...files.keys()].map((name) => `${out}/${name}`) }, io);
    else await io.out(`${[...files.keys()].map((name) => `${out}/${name}\n`).join('')}`);
    return 0;
  },
};

/** @returns why a file could not be written */
function writeAll(folder: string, files: ReadonlyMap<string, string>): string | undefined {
  for (const [name, text] of files) {
    const written = writeInFolder(join(folder, name), [text]);
    if ('failure' in written) return `${name} could not be written: ${written.failure}`;
  }
  return undefined;
}
