/** Files that can't be read, or never end, given to each subcommand in each place where it takes a file. */
import { execFileSync } from 'node:child_process';
import { chmodSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Attempt } from '../attack.ts';
import { marrow } from './process.ts';
import { bvh, makeHardFiles, makeScene } from './scene.ts';
import { tell } from './tell.ts';
import { leftovers } from './whole.ts';

/** How a file is given; `?` is its name. */
const PLACES: readonly (readonly string[])[] = [
  ['info', '?'],
  ['info', 'a.skel', '--', '?', '--json'],
  ['pose', '?'],
  ['ik', '?', '--pin', '#0=0,1,0'],
  ['channels', '?', '--times', '0'],
  ['compare', 'a.skel', '?'],
  ['grade', '?', '--reference', 'right'],
  ['grade', 'class', '--reference', '?'],
  ['kit', '?'],
  ['convert', '?', 'new.anim'],
  ['convert', 'takes/t0.bvh', '?/new.bvh'],
  ['convert', '--', 'takes/t0.bvh', '?'],
  ['convert', '?', '--to', 'anim', '--out', 'new', '--force'],
  ['convert', 'takes', '--to', 'bvh', '--out', '?'],
  ['convert', '?', '--to', 'bvh', '--out', 'new', '--jobs', '1', '--force'],
  ['convert', 'takes/t0.bvh', '--retarget', '?', 'new.bvh'],
  ['convert', 'takes/t0.bvh', '--retarget', 'takes/t1.bvh', '--map', '?', 'new.bvh'],
  ['export', '?', '--to', 'npz', '--out', 'new', '--force'],
  ['export', 'takes', '--to', 'csv', '--out', '?'],
  ['export', 'takes', '--to', 'npz', '--out', 'new', '--only', '?', '--force'],
  ['export', '--files-from', '?', '--to', 'npz', '--out', 'new', '--force'],
  ['export', 'takes', '--space', '?', '--to', 'npz', '--out', 'new', '--force'],
  ['review', '?'],
  ['review', 'takes', '--list', '?'],
  ['review', 'takes', '--out', '?'],
];
/** Whoever may read everything is not refused: such tries run as this user. */
const NOBODY = ['setpriv', '--reuid=65534', '--regid=65534', '--clear-groups'];

/** Tries this many, each with a hard file in a place. Returns the most memory, in MB. */
export async function tryFiles(attempt: Attempt, count: number): Promise<number> {
  let most = 0;
  const isRoot = process.getuid?.() === 0;
  for (let i = 0; i < count; i++) {
    const scene = makeScene();
    const hard = await makeHardFiles(scene.folder);
    try {
      const name = hard.names[attempt.below(hard.names.length)];
      const args = PLACES[attempt.below(PLACES.length)].map((arg) => arg.replace('?', () => name));
      const prefix = isRoot && attempt.below(2) === 0 ? NOBODY : [];
      if (prefix.length > 0) chmodSync(scene.folder, attempt.below(2) === 0 ? 0o777 : 0o755);
      const ended = await marrow(args, scene.folder, { prefix });
      most = Math.max(most, ended.memoryMb);
      tell(attempt, args, ended, leftovers(scene.folder));
    } finally {
      hard.close();
      scene.remove();
    }
  }
  return most;
}

/** Folders with all hard files at once, with very many files, and very deep ones. */
export async function tryFolders(attempt: Attempt): Promise<void> {
  const scene = makeScene();
  const many = join(scene.folder, 'many');
  mkdirSync(many);
  for (let i = 0; i < 10_000; i++) writeFileSync(join(many, `t${i}.bvh`), i % 100 === 0 ? bvh(2) : '');
  const deep = join(scene.folder, 'deep', ...Array.from({ length: 500 }, () => 'd'));
  mkdirSync(deep, { recursive: true });
  writeFileSync(join(deep, 't.bvh'), bvh(2));
  mkdirSync(join(scene.folder, 'hard'));
  const hard = await makeHardFiles(join(scene.folder, 'hard'));
  try {
    for (const folder of ['many', 'deep', 'hard', '.']) {
      for (const args of [
        ['info', folder],
        ['review', folder],
        ['convert', folder, '--to', 'anim', '--out', `new-${folder}`],
        ['export', folder, '--to', 'npz', '--out', `npz-${folder}`],
        ['convert', folder, '--to', 'bvh', '--out', `${folder}/inside`],
      ]) {
        const ended = await marrow(args, scene.folder);
        tell(attempt, args, ended, leftovers(scene.folder));
      }
    }
  } finally {
    hard.close();
    scene.remove();
  }
}

/** Pipes that are read once, never end, or files that grow or vanish while they are read. */
export async function tryStreams(attempt: Attempt): Promise<void> {
  const scene = makeScene();
  try {
    const run = async (script: string) => {
      const ended = await marrow([], scene.folder, { prefix: ['bash', '-c', script] });
      tell(attempt, [script], ended, leftovers(scene.folder));
    };
    const command = '"$0" "$1" "$2"';
    execFileSync('mkfifo', [join(scene.folder, 'p.bvh')]);
    writeFileSync(join(scene.folder, 'growing.bvh'), bvh(20));
    await run(`cat takes/t0.bvh > p.bvh & ${command} info p.bvh`);
    await run(`echo nonsense > p.bvh & ${command} info p.bvh`);
    await run(`cat takes/t0.bvh > p.bvh & ${command} export p.bvh --to npz --out new`);
    await run(`(yes '1 2 3' > p.bvh) 2> /dev/null & ${command} info p.bvh`);
    await run(`${command} compare a.skel <(yes '1 0 0 0')`);
    await run(`${command} compare a.skel <(cat dump.txt)`);
    await run(
      `(yes '1 2 3 4 5 6' | head -c 60M >> growing.bvh) & ${command} info growing.bvh; code=$?; wait; exit $code`,
    );
    await run(
      `(for i in {1..200}; do mv takes/t1.bvh x; mv x takes/t1.bvh; done) & ${command} review takes; code=$?; wait; exit $code`,
    );
    await run(
      `(for i in {1..300}; do : > takes/t1.bvh; cat takes/t2.bvh > takes/t1.bvh; done) & ${command} export takes --to npz --out new --force; code=$?; wait; exit $code`,
    );
  } finally {
    scene.remove();
  }
}
