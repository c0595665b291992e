/** Outputs that can't be written: full disks, closed pipes, kills at any moment, two processes at once. */
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Attempt } from '../attack.ts';
import { marrow } from './process.ts';
import { bvh, makeScene, type Scene } from './scene.ts';
import { tell } from './tell.ts';
import { filesBelow, leftovers, torn } from './whole.ts';

/** Commands that write into `new/`; the last one is killed and goes on. */
const WRITERS: readonly (readonly string[])[] = [
  ['convert', 'long.bvh', 'new/out.bvh'],
  ['convert', 'long.bvh', 'new/out.anim'],
  ['convert', 'long.bvh', 'new/out.glb'],
  ['convert', 'takes', '--to', 'anim', '--out', 'new', '--force'],
  ['convert', 'takes', '--to', 'bvh', '--out', 'new', '--jobs', '2', '--resume', '--no-times'],
  ['export', 'takes', '--to', 'npz', '--out', 'new', '--jobs', '2', '--resume', '--no-times'],
  ['export', 'takes', '--to', 'csv', '--out', 'new', '--jobs', '1', '--resume', '--no-times'],
];

function makeLongScene(): Scene {
  const scene = makeScene();
  writeFileSync(join(scene.folder, 'long.bvh'), bvh(20_000));
  for (let i = 0; i < 24; i++) writeFileSync(join(scene.folder, 'takes', `u${i}.bvh`), bvh(600 + i));
  mkdirSync(join(scene.folder, 'new'));
  return scene;
}

function emptied(folder: string): void {
  rmSync(folder, { recursive: true });
  mkdirSync(folder);
}

/** Kills so many commands at random moments, then lets each of them run to its end. Returns how many were killed in time. */
export async function tryKills(attempt: Attempt, count: number): Promise<number> {
  const scene = makeLongScene();
  const out = join(scene.folder, 'new');
  let killed = 0;
  try {
    for (const args of WRITERS) {
      emptied(out);
      const whole = await marrow(args, scene.folder);
      const after = filesBelow(out);
      for (let i = 0; i < count / WRITERS.length; i++) {
        emptied(out);
        const before = new Map<string, string>();
        const isReplaced = attempt.below(2) === 0;
        if (isReplaced) {
          for (const name of after.keys()) {
            if (name.includes('manifest')) continue;
            mkdirSync(join(out, name, '..'), { recursive: true });
            writeFileSync(join(out, name), 'before');
          }
          for (const [name, hash] of filesBelow(out)) before.set(name, hash);
        }
        const signal = attempt.below(2) === 0 ? 'SIGKILL' : 'SIGTERM';
        const ended = await marrow(args, scene.folder, { kill: { afterMs: attempt.random() * whole.ms, signal } });
        if (ended.code === undefined) killed++;
        const isExport = args.includes('--resume');
        // A killed process can't tidy up; an export keeps its journal, to go on from.
        const left = signal === 'SIGKILL' || isExport ? [] : leftovers(out);
        tell(attempt, args, ended, [...torn(filesBelow(out), before, after), ...left]);
        const again = await marrow(args, scene.folder);
        const differs = [...after].filter(([name, hash]) => filesBelow(out).get(name) !== hash);
        const wrong = differs.map(([name]) => `${name} differs after a second run`);
        tell(attempt, args, again, [...leftovers(out), ...wrong]);
      }
    }
  } finally {
    scene.remove();
  }
  return killed;
}

/** Of full disks, and limits on sizes of files; 0 has no room for a file at all. */
const ROOMS_KB = [0, 4, 16, 64, 256];

/** So many writers on disks of a few kilobytes, and with a limit on the sizes of files; results that nobody can take. */
export async function tryDisks(attempt: Attempt, count: number): Promise<void> {
  const scene = makeLongScene();
  const out = join(scene.folder, 'new');
  const all = [...WRITERS, ['kit', 'new', '--force'], ['review', 'takes', '--out', 'new/list.csv']];
  let isAllowed = true;
  try {
    for (let i = 0; i < count; i++) {
      const args = all[attempt.below(all.length)];
      const kb = ROOMS_KB[attempt.below(ROOMS_KB.length)];
      isAllowed &&= mounted(out, kb);
      try {
        await fill(attempt, scene, args, isAllowed ? [] : ['prlimit', `--fsize=${1 + kb * 1024}`]);
      } finally {
        if (isAllowed) execFileSync('umount', [out]);
      }
      await fill(attempt, scene, args, ['prlimit', `--fsize=${1 + kb * 1024}`]);
      emptied(out);
    }
    for (const args of [
      ['info', 'takes'],
      ['review', 'takes'],
      ['kit', 'new/kit'],
    ]) {
      const ended = await marrow(args, scene.folder, { stdout: '/dev/full' });
      tell(attempt, [...args, '> /dev/full'], ended, ended.code === 0 ? ['it ended with 0, with nothing written'] : []);
    }
    if (!isAllowed) attempt.note('full disks not tried: no right to mount one');
  } finally {
    scene.remove();
  }
}

async function fill(attempt: Attempt, scene: Scene, args: readonly string[], prefix: readonly string[]): Promise<void> {
  const out = join(scene.folder, 'new');
  const ended = await marrow(args, scene.folder, { prefix });
  const left = args.includes('--resume') ? [] : leftovers(out);
  // What is there was written whole; what that is, a run without a limit says.
  const reference = join(scene.folder, 'reference');
  const whole = args.map((arg) => arg.replace(/^new/, 'reference'));
  mkdirSync(reference, { recursive: true });
  await marrow(whole, scene.folder);
  const isWhole = filesBelow(reference);
  tell(attempt, [...prefix, ...args], ended, [...left, ...torn(filesBelow(out), new Map(), isWhole)]);
  rmSync(reference, { recursive: true });
}

function mounted(folder: string, kb: number): boolean {
  try {
    execFileSync(
      'mount',
      ['-t', 'tmpfs', '-o', `size=${Math.max(kb, 4)}k,nr_inodes=${kb === 0 ? 1 : 40}`, 'tmpfs', folder],
      { stdio: 'ignore' },
    );
    return true;
  } catch {
    return false;
  }
}

/** Readers that go away, and streams that are closed from the start. */
export async function tryPipes(attempt: Attempt): Promise<void> {
  const scene = makeLongScene();
  const command = '"$0" "$1" "$2"';
  try {
    for (const args of [
      'info takes',
      'pose long.bvh --times 0,1,2,3,4,5,6,7,8,9 --json',
      'review takes',
      'kit new --force',
      '--help',
      'info none.bvh',
      'convert takes --to anim --out new --force',
      'grade class --reference right --html',
    ]) {
      for (const end of [
        '| head -1',
        '| head -c 1',
        '| true',
        '>&-',
        '2>&-',
        '>&- 2>&-',
        '<&-',
        '2>&1 | head -c 1',
        '> /dev/null 2> /dev/full',
      ]) {
        const script = `${command} ${args} ${end}; exit \${PIPESTATUS[0]}`;
        const ended = await marrow([], scene.folder, { prefix: ['bash', '-c', script] });
        // Whoever closes the stream of messages asked for none.
        const isMute = /2>/.test(end) && ended.err === '' && ended.code !== undefined && ended.code < 4;
        tell(attempt, [args, end], isMute ? { ...ended, code: 0 } : ended, leftovers(scene.folder));
      }
    }
  } finally {
    scene.remove();
  }
}

/** Several processes that write the same outputs: these are of one of them, whole. */
export async function tryTogether(attempt: Attempt): Promise<void> {
  const scene = makeLongScene();
  const out = join(scene.folder, 'new');
  try {
    for (const args of WRITERS) {
      await marrow(args, scene.folder);
      const after = filesBelow(out);
      cpSync(join(scene.folder, 'long.bvh'), join(scene.folder, 'own.bvh'));
      const all = await Promise.all([1, 2, 3].map(() => marrow(args, scene.folder)));
      const wrong = torn(filesBelow(out), new Map(), after);
      for (const ended of all) tell(attempt, [...args, '(three at once)'], ended, wrong);
      emptied(out);
    }
    // An output that is its own input.
    const own = await marrow(['convert', 'own.bvh', 'own.bvh'], scene.folder);
    const isRead = /Frames: 20000/.test(readFileSync(join(scene.folder, 'own.bvh'), 'utf8'));
    tell(attempt, ['convert', 'own.bvh', 'own.bvh'], own, isRead ? [] : ['own.bvh is half written']);
  } finally {
    scene.remove();
  }
}
