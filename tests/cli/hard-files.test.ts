/** Files that can't be read or written, and names that try to control the terminal, by all subcommands. */

import { createHash } from 'node:crypto';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { hostname, tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { fileBytes, readPieces } from '../../src/cli/read-file.ts';
import { reasonOf } from '../../src/cli/reason.ts';
import { COMMANDS } from '../../src/cli/run.ts';
import { writeOutput } from '../../src/cli/write-output.ts';
import { randomFrom } from '../attack/attack.ts';
import { randomArguments } from '../attack/command/arguments.ts';
import { faultsOf } from '../attack/command/process.ts';
import { bvh, makeScene, ODD_NAMES, type Scene } from '../attack/command/scene.ts';
import { filesBelow, leftovers } from '../attack/command/whole.ts';
import { command } from '../helpers/command.ts';

let scene: Scene;
const at = (name: string) => join(scene.folder, name);
beforeAll(() => {
  scene = makeScene();
  symlinkSync('loop2.bvh', at('loop1.bvh'));
  symlinkSync('loop1.bvh', at('loop2.bvh'));
  mkdirSync(at('folder.bvh'));
  mkdirSync(at('odd'));
  for (const name of ODD_NAMES) writeFileSync(at(`odd/${name}`), bvh(3));
  symlinkSync('nowhere.bvh', at('odd/dangling.bvh'));
  writeFileSync(Buffer.concat([Buffer.from(at('odd/bad-')), Buffer.of(0xff), Buffer.from('.bvh')]), bvh(3));
});
afterAll(() => scene.remove());

/** Runs it, and holds it to what every run is held to. */
async function held(...args: string[]) {
  const ended = await command(args, scene.folder, async () => '');
  expect([args, faultsOf(ended)]).toEqual([args, []]);
  return ended;
}

it('every subcommand answers odd arguments with a documented exit code and words', async () => {
  const random = randomFrom(7);
  for (const each of COMMANDS) {
    for (let i = 0; i < 12; i++) await held(...randomArguments(each, (count) => Math.floor(random() * count)));
  }
  expect(leftovers(scene.folder)).toEqual([]);
});

const LONG = 'x'.repeat(5000);
it.each([
  [['info', 'loop1.bvh'], 1, 'loop1.bvh error file-unreadable: The file could not be read: its links form a loop.'],
  [['info', 'a.skel/b.bvh'], 1, 'a part of its path is a file, not a folder.'],
  [['info', LONG], 1, 'its name or path is too long for the system.'],
  [['export', 'loop1.bvh', '--to', 'npz', '--out', 'new'], 1, 'its links form a loop.'],
  [['review', 'takes', '--list', 'folder.bvh'], 2, '--list: folder.bvh could not be read: it is a folder.'],
  [
    ['export', 'takes', '--to', 'npz', '--out', 'new', '--only', 'none.csv'],
    2,
    '--only: none.csv could not be read: there is no such',
  ],
  [
    ['export', 'takes', '--to', 'npz', '--out', 'new', '--retarget', 'right', '--map', 'right'],
    2,
    '--map takes a file; right is not one.',
  ],
  [['export', 'takes', '--to', 'npz', '--out', 'new', '--jobs', '1e9'], 2, '--jobs takes a whole number from 1 to 512'],
  [['export', 'takes', '--to', 'npz', '--out', 'a.skel'], 2, 'a file of this name exists.'],
  [
    ['convert', 'takes', '--to', 'anim', '--out', 'a.skel/new'],
    3,
    'its folder could not be created: a part of its path is a file',
  ],
  [['convert', 'takes/t0.bvh', 'takes'], 2, 'The format of "takes" is unknown'],
  [['convert', 'takes/t0.bvh', 't.npz'], 2, 'Arrays are written by "marrow export --to npz"'],
  [['convert', 'takes/t0.bvh', 'a.skel', 'o.glb'], 1, 'name the files of the other by --retarget, one each'],
  [['convert', 'takes/t0.bvh', 'folder.bvh'], 3, 'something other than a file has this name'],
  [['convert', 'takes/t0.bvh', 'none/out.bvh'], 3, 'The file could not be written: there is no such file or folder.'],
  [['kit', 'list.csv'], 3, 'could not be written: its folder could not be created: a file of this name exists'],
] as const)('with %j the command ends in words', async (args, code, words) => {
  const { code: ended, err } = await held(...args);
  expect([ended, err]).toEqual([code, expect.stringContaining(words)]);
});

it('a part of very many looks for the others until one is missing', async () => {
  const ended = await held('export', 'takes', '--to', 'npz', '--out', 'shard', '--shard', '1/99999999999999999999');
  expect(ended.code).toBe(0);
});

describe('files with odd names', () => {
  it('files with odd names are read and written; dangling links and names that are not UTF-8 are told', async () => {
    const { code, err } = await held('convert', 'odd', '--to', 'anim', '--out', 'odd-out');
    expect(code).toBe(1);
    expect(err).toContain('odd/dangling.bvh error file-unreadable: The file could not be read: there is no such file');
    expect(err).toContain('its name is not UTF-8; rename it.');
    // With the ending of its output a name of 255 bytes has one more.
    expect(err).toContain('its name or path is too long for the system.');
    expect(err.match(/ error /g)).toHaveLength(3);
    // A converted capture is an animation with its skeleton.
    const written = readdirSync(at('odd-out'));
    expect(written.filter((name) => name.endsWith('.anim'))).toHaveLength(ODD_NAMES.length - 1);
  });

  it('names with line ends and controls are told in one line', async () => {
    writeFileSync(at('x\ny\x1b[31m\u202e.skel'), 'balljoint {');
    const { err } = await held('info', 'x\ny\x1b[31m\u202e.skel');
    expect(err).toMatch(/^x\ufffdy\ufffd\[31m\ufffd\.skel:1:12 error /);
  });
});

describe('readPieces', () => {
  it('readPieces refuses a file that grows or shrinks while it is read', () => {
    const path = at('changing');
    for (const change of [new Uint8Array(3 << 20), 'x']) {
      writeFileSync(path, new Uint8Array(2 << 20));
      expect(() => readPieces(path, () => writeFileSync(path, change))).toThrow('it changed while it was being read');
    }
  });

  it('files without a size are read to their end, endless ones up to a limit', () => {
    expect(fileBytes('/proc/self/status').length).toBeGreaterThan(100);
    expect(() => readPieces('/dev/zero', () => undefined)).toThrow('it has more than 256 MB or no end');
    expect(fileBytes('/dev/null')).toHaveLength(0);
  });
});

describe('writeOutput', () => {
  it('writeOutput writes names of 255 bytes, and says why it could not write', () => {
    const name = `${'\u00e9'.repeat(125)}.skel`;
    expect(writeOutput(at(name), ['x'])).toEqual({ bytes: 1 });
    expect(readFileSync(at(name), 'utf8')).toBe('x');
    expect(writeOutput(at(`${LONG}.skel`), ['x'])).toEqual({ failure: 'its name or path is too long for the system' });
    expect(writeOutput(at('none/x.skel'), ['x'])).toEqual({ failure: 'there is no such file or folder' });
    expect(writeOutput(at('takes'), ['x'])).toEqual({ failure: 'something other than a file has this name' });
  });

  it('writeOutput removes what killed processes of this machine left, and no others', () => {
    const folder = mkdtempSync(join(tmpdir(), 'marrow-stale-'));
    try {
      const machine = createHash('sha256').update(hostname()).digest('hex').slice(0, 8);
      const other = `x.skel.00000000-${2 ** 30}-0a1b2c3d.tmp`;
      const running = `x.skel.${machine}-${process.pid}-0a1b2c3d.tmp`;
      for (const name of [other, running, `x.skel.${machine}-${2 ** 30}-0a1b2c3d.tmp`]) {
        writeFileSync(join(folder, name), 'half');
      }
      writeOutput(join(folder, 'y.skel'), ['y']);
      expect([...filesBelow(folder).keys()].sort()).toEqual([other, running, 'y.skel'].sort());
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
});

it('errors of the system are told in words, others by their message', () => {
  expect(reasonOf(Object.assign(new Error('ENOSPC: no space left'), { code: 'ENOSPC' }))).toBe('the disk is full');
  expect(reasonOf(Object.assign(new Error('own words'), { code: 'constructor' }))).toBe('own words');
  expect(reasonOf('thrown text')).toBe('thrown text');
});
