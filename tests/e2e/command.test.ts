/** The built command as a process: exit codes, pipes and npm's folders. */
import { execFile, spawn } from 'node:child_process';
import {
  accessSync,
  closeSync,
  constants,
  existsSync,
  mkdirSync,
  mkdtempSync,
  openSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const BUILT = join(ROOT, 'build', 'marrow.js');
/** Enough joints for several megabytes of JSON, far more than a pipe buffers. */
const JOINTS = 12_000;

let folder = '';
beforeAll(() => {
  if (!existsSync(BUILT)) throw new Error('build/marrow.js is not there: "npm run build" first.');
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
  writeFileSync(join(folder, 'small.skel'), 'balljoint root { offset 0 1 0 }');
  const flat = Array.from({ length: JOINTS - 1 }, (_, i) => `balljoint j${i} { offset ${i / 7} 0 0 }`).join('\n');
  writeFileSync(join(folder, 'wide.skel'), `balljoint root {\n${flat}\n}\n`);
  writeFileSync(join(folder, 'broken.skel'), 'balljoint root { offset 0 1,5 0 }');
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

interface Ended {
  readonly code: number;
  readonly out: string;
  readonly err: string;
}

function start(file: string, args: readonly string[]): Promise<Ended> {
  return new Promise((resolve) => {
    // On Windows npm is a shell script.
    const options = { cwd: folder, maxBuffer: 2 ** 28, shell: file === 'npm' && process.platform === 'win32' };
    const child = execFile(file, args, options, (_, out, err) => resolve({ code: child.exitCode ?? -1, out, err }));
  });
}
const marrow = (...args: string[]) => start(process.execPath, [BUILT, ...args]);

describe('the built command', () => {
  it('the built command is a program of its own', () => {
    if (process.platform !== 'win32') accessSync(BUILT, constants.X_OK);
  });

  it('ends with 0, 1 and 2, with results on one stream and talk on the other', async () => {
    const [good, broken, wrong] = await Promise.all([
      marrow('pose', 'small.skel', '--root', '-1,0,0', '--json'),
      marrow('info', 'broken.skel', '--json'),
      marrow('info', '--nonsense'),
    ]);
    expect(good).toMatchObject({ code: 0, err: '' });
    expect(JSON.parse(good.out).characters[0].joints[0].world.slice(12)).toEqual([-1, 1, 0, 1]);
    expect(broken).toMatchObject({ code: 1, err: expect.stringContaining('broken.skel:1:') });
    expect(JSON.parse(broken.out).diagnostics).toHaveLength(1);
    expect(wrong).toMatchObject({ code: 2, out: '', err: expect.stringContaining('usage: marrow info') });
  });

  it('exports takes in several threads as in one, byte for byte, and in parts, one of which was killed', async () => {
    const rows = Array.from({ length: 40 }, (_, f) => `${f} 90 ${-f} ${3 * f} ${f} ${2 * f}`).join('\n');
    mkdirSync(join(folder, 'takes'), { recursive: true });
    for (let i = 0; i < 12; i++) {
      const hips = `OFFSET 0 ${90 + i} 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation`;
      const text = `HIERARCHY ROOT Hips { ${hips} End Site { OFFSET 0 9 0 } } MOTION Frames: 40 Frame Time: 0.01\n${rows}\n`;
      writeFileSync(join(folder, 'takes', `t${i}.bvh`), i === 7 ? text.replace('90', 'ninety') : text);
    }
    const args = (out: string, ...more: string[]) => [
      'export',
      'takes',
      '--to',
      'npz',
      '--out',
      out,
      '--no-times',
      ...more,
    ];
    const [one, two] = await Promise.all([
      marrow(...args('one', '--jobs', '1')),
      marrow(...args('two', '--jobs', '2')),
    ]);
    expect([one.code, two.code]).toEqual([1, 1]);
    expect(one.err).toMatch(/^takes\/t7\.bvh: /);
    // What a killed process leaves: a file half written, and a journal with half a line.
    const left = join(folder, 'parts', '.marrow-1-of-2', 'abc');
    mkdirSync(left, { recursive: true });
    writeFileSync(join(left, 't3.npz.1-abc.tmp'), 'half');
    writeFileSync(join(left, 'journal.ndjson'), '{"input":"takes/t0.bvh","has');
    for (const part of ['1/2', '2/2']) await marrow(...args('parts', '--shard', part, '--resume'));
    const names = readdirSync(join(folder, 'one')).sort();
    expect(names).toHaveLength(12);
    const bytes = (out: string, name: string) => readFileSync(join(folder, out, name)).toString('latin1');
    for (const name of names) {
      expect(bytes('two', name) === bytes('one', name), name).toBe(true);
      expect(bytes('parts', name) === bytes('one', name), name).toBe(true);
    }
    expect(readdirSync(join(folder, 'two')).sort()).toEqual(names);
    expect(
      readdirSync(join(folder, 'parts'))
        .filter((name) => !/^manifest\.\d-of-2/.test(name))
        .sort(),
    ).toEqual(names);
  });

  it('grades a class in several threads as in one, and goes on after a broken submission', async () => {
    const skel = 'balljoint root { offset 0 1 0 pose 0.1 0.2 0.3 }';
    const write = (path: string, text: string) => {
      mkdirSync(join(folder, path), { recursive: true });
      writeFileSync(join(folder, path, 'test.skel'), text);
    };
    write('ref', skel);
    for (let i = 0; i < 12; i++)
      write(`class/s${i}`, i === 3 ? 'balljoint {' : i === 5 ? skel.replace('0.3', '0.4') : skel);
    const { code, out } = await marrow('grade', 'class', '--reference', 'ref', '--json');
    expect(code).toBe(1);
    const { submissions } = JSON.parse(out);
    expect(submissions.map(({ name }: { name: string }) => name)).toEqual(
      Array.from({ length: 12 }, (_, i) => `s${i}`),
    );
    const verdicts = submissions.map(({ verdict }: { verdict: string }) => verdict);
    expect(verdicts.slice(2, 7)).toEqual(['right', 'not judged', 'right', 'wrong', 'right']);
  });

  it('writes long results whole into a pipe that is read late', async () => {
    const child = spawn(process.execPath, [BUILT, 'pose', 'wide.skel', '--json'], { cwd: folder });
    const ended = new Promise((resolve) => child.once('close', resolve));
    // Read only after the pipe is full.
    await new Promise((resolve) => child.stdout.once('readable', resolve));
    let text = '';
    child.stdout.setEncoding('utf8').on('data', (part) => {
      text += part;
    });
    const code = await ended;
    expect(code).toBe(0);
    expect(text.length).toBeGreaterThan(1_000_000);
    expect(JSON.parse(text).characters[0].joints).toHaveLength(JOINTS);
  });

  it('the built command stays quiet when its reader goes away', async () => {
    const child = spawn(process.execPath, [BUILT, 'pose', 'wide.skel', '--json'], { cwd: folder });
    let err = '';
    child.stderr.on('data', (part) => {
      err += part;
    });
    child.stdout.once('data', () => child.stdout.destroy());
    await new Promise((resolve) => child.once('close', resolve));
    expect(err).toBe('');
  });

  it('the built command says that its results could not be written, and ends with 3', async () => {
    const full = openSync('/dev/full', 'w');
    const child = spawn(process.execPath, [BUILT, 'info', 'small.skel'], {
      cwd: folder,
      stdio: ['ignore', full, 'pipe'],
    });
    let err = '';
    child.stderr?.on('data', (part) => {
      err += part;
    });
    const code = await new Promise((resolve) => child.once('close', resolve));
    closeSync(full);
    expect([code, err]).toEqual([3, 'marrow: the results could not be written: the disk is full.\n']);
  });

  it('the built command ends at a signal with its output whole or untouched, and nothing beside it', async () => {
    const rows = Array.from({ length: 30_000 }, (_, f) => `${f} 90 ${-f} ${3 * f} ${f} ${2 * f}`).join('\n');
    const hips = 'OFFSET 0 90 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation';
    const text = `HIERARCHY ROOT Hips { ${hips} End Site { OFFSET 0 9 0 } } MOTION Frames: 30000 Frame Time: 0.01\n${rows}\n`;
    mkdirSync(join(folder, 'signal'));
    writeFileSync(join(folder, 'signal', 'long.bvh'), text);
    const child = spawn(process.execPath, [BUILT, 'convert', 'signal/long.bvh', 'signal/out.bvh'], { cwd: folder });
    const ended = new Promise((resolve) => child.once('close', resolve));
    // An unfinished file is there while it is written.
    const isWriting = () => readdirSync(join(folder, 'signal')).length > 1;
    while (!isWriting() && child.exitCode === null) await new Promise((resolve) => setImmediate(resolve));
    child.kill('SIGTERM');
    await ended;
    const names = readdirSync(join(folder, 'signal')).filter((name) => name !== 'long.bvh');
    expect([[], ['out.bvh']]).toContainEqual(names);
    for (const name of names)
      expect(readFileSync(join(folder, 'signal', name), 'utf8').split('\n').length).toBeGreaterThan(30_000);
  });

  it('takes paths from where the caller is, under npm too', async () => {
    const ended = await start('npm', ['--prefix', ROOT, 'run', '-s', 'marrow', '--', 'info', 'small.skel', '--json']);
    expect(ended.code).toBe(0);
    expect(JSON.parse(ended.out).files).toMatchObject([{ name: 'small.skel', joints: 1 }]);
  });
});
