/** A folder of files that the command reads, and of such as it can't. */
import { execFileSync } from 'node:child_process';
import {
  chmodSync,
  closeSync,
  ftruncateSync,
  mkdirSync,
  mkdtempSync,
  openSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export const SKEL = 'balljoint root { offset 0 1 0 balljoint tip { offset 0 1 0 pose 0.1 0.2 0.3 } }';
export const ANIM = `animation { range 0 2 numchannels 9 ${'channel { extrapolate constant constant keys 2 { 0 0 flat flat 2 1 flat flat } } '.repeat(9)}}`;
export const DUMP = '1 0 0 0\n0 1 0 1\n0 0 1 0\n0 0 0 1\n';

/** Motion capture of one joint. */
export function bvh(frames: number, name = 'Hips'): string {
  const rows = Array.from({ length: frames }, (_, f) => `${f / 7} 90 ${-f} ${(3 * f) / 11} ${f} ${2 * f}`).join('\n');
  const channels = 'CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation';
  return `HIERARCHY ROOT ${name} { OFFSET 0 90 0 ${channels} End Site { OFFSET 0 9 0 } } MOTION Frames: ${frames} Frame Time: 0.01\n${rows}\n`;
}

export interface Scene {
  /** Absolute; commands run here. What is beside it is theirs as well, so that `..` does no harm. */
  readonly folder: string;
  remove(): void;
}

/** `a.skel`, `a.anim`, `dump.txt`, `takes/t0.bvh` to `t5.bvh`, and a class with its reference. */
export function makeScene(): Scene {
  const home = mkdtempSync(join(tmpdir(), 'marrow-attack-'));
  // Another user reads it in some tries.
  chmodSync(home, 0o755);
  const folder = join(home, 'work');
  for (const name of ['takes', 'class/ann', 'class/bob', 'right']) mkdirSync(join(folder, name), { recursive: true });
  const write = (name: string, text: string) => writeFileSync(join(folder, name), text);
  for (const place of ['', 'class/ann/', 'right/']) write(`${place}a.skel`, SKEL);
  write('class/bob/a.skel', SKEL.replace('0.3', '0.4'));
  write('a.anim', ANIM);
  write('dump.txt', DUMP);
  write('list.csv', 'path,verdict\ntakes/t1.bvh,good\n');
  write('paths.txt', 'takes/t0.bvh\ntakes/t1.bvh\n');
  for (let i = 0; i < 6; i++) write(`takes/t${i}.bvh`, bvh(20 + i));
  return { folder, remove: () => rmSync(home, { recursive: true, force: true }) };
}

/** Names that file systems allow and programs forget. */
export const ODD_NAMES: readonly string[] = [
  '-rf.bvh',
  '--json.bvh',
  '--.bvh',
  ' .bvh',
  'a\nb.bvh',
  'a\r\x1b[31mred\x07.bvh',
  '\u009b31m.bvh',
  '\u202egpj.bvh',
  'e\u0301\u00e9\u{1f600}.bvh',
  'C:\\x.bvh',
  '%2e%2e%2f.bvh',
  '$(id)`id`;&.bvh',
  '__proto__.bvh',
  `${'n'.repeat(251)}.bvh`,
];

/** Without content on disk: of whole characters and archives more than a buffer holds, of lists more than has lines. */
const LARGE = new Map([
  ['large.glb', 2 ** 31 + 1],
  ['large.zip', 2 ** 31 + 1],
  ['large.csv', 2 ** 28 + 1],
]);

/** Files that can't be read, by their names. Some block or never end where they are opened without care. */
export async function makeHardFiles(folder: string): Promise<{ readonly names: readonly string[]; close(): void }> {
  const at = (name: string) => join(folder, name);
  symlinkSync('loop2.bvh', at('loop1.bvh'));
  symlinkSync('loop1.bvh', at('loop2.bvh'));
  symlinkSync('nowhere.bvh', at('dangling.bvh'));
  mkdirSync(at('folder.bvh'));
  mkdirSync(at('round'));
  symlinkSync('..', at('round/up'));
  execFileSync('mkfifo', [at('pipe.bvh')]);
  for (const device of ['null', 'full', 'zero', 'urandom', 'tty']) symlinkSync(`/dev/${device}`, at(`${device}.bvh`));
  symlinkSync('/proc/self/mem', at('mem.bvh'));
  symlinkSync('/proc/self/status', at('status.bvh'));
  for (const ending of ['skel', 'anim', 'glb', 'zip', 'csv']) writeFileSync(at(`empty.${ending}`), '');
  writeFileSync(at('zeros.bvh'), new Uint8Array(70_000));
  for (const [name, bytes] of LARGE) {
    const file = openSync(at(name), 'w');
    ftruncateSync(file, bytes);
    closeSync(file);
  }
  writeFileSync(at('locked.bvh'), bvh(3));
  chmodSync(at('locked.bvh'), 0);
  mkdirSync(at('locked'));
  writeFileSync(at('locked/t.bvh'), bvh(3));
  chmodSync(at('locked'), 0);
  for (const name of ODD_NAMES) writeFileSync(at(name), bvh(3));
  writeFileSync(Buffer.concat([Buffer.from(at('bad-')), Buffer.of(0xff, 0xfe), Buffer.from('.bvh')]), bvh(3));
  const server = createServer();
  await new Promise<void>((resolve) => server.listen(at('socket.bvh'), resolve));
  const links = ['loop1.bvh', 'dangling.bvh', 'folder.bvh', 'round', 'round/up/up'];
  const devices = ['null.bvh', 'full.bvh', 'zero.bvh', 'urandom.bvh', 'tty.bvh', 'mem.bvh', 'status.bvh', 'socket.bvh'];
  const empty = ['empty.skel', 'empty.anim', 'empty.glb', 'empty.zip', 'empty.csv', 'zeros.bvh'];
  const large = [...LARGE.keys()];
  const names = [...links, ...devices, ...empty, ...large, ...ODD_NAMES, 'locked.bvh', 'locked', 'a.skel/b.bvh'];
  return { names: [...names, `${'x/'.repeat(3000)}y.bvh`], close: () => void server.close() };
}
