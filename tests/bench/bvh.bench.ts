/**
 * Reading 100 MB of motion capture: ours, in pieces as a File's stream gives them, against a bare loop that parses the
 * same numbers into a Float32Array without checks, three.js's BVHLoader, and the npm package bvh-loader. Goals: at most
 * 1.5 times the bare loop's time for numbers of up to 15 digits and 3 times for 17; at least 50 times the throughput of
 * BVHLoader and 4 times that of bvh-loader. The summary at the end prints these ratios.
 *
 * The file is a real take with its rows repeated (a generated one without the reference files); for more digits, the
 * same values times a factor near 1. The two others take strings, prepared before timing. BVHLoader removes lines from
 * the front of a list, which is slower for longer lists: so it gets the whole file, and one run (some 20 s).
 */
import { MEBvh } from 'bvh-loader/module/bvh-loader.js';
import { BVHLoader } from 'three/addons/loaders/BVHLoader.js';
import { afterAll, bench, describe } from 'vitest';
import { bvhReader } from '../../src/formats/bvh/read.ts';
import { hasShared, sharedBytes } from '../helpers/shared.ts';
import { bareLoop, countNumbers } from './bare-loop.ts';

const SIZE = 100e6;
/** About the chunk size of a File's stream. */
const PIECE = 65536;
const LONG = { time: 0, iterations: 8, warmupTime: 0, warmupIterations: 2 };
const LONGER = { time: 0, iterations: 2, warmupTime: 0, warmupIterations: 1 };
const LONGEST = { time: 0, iterations: 1, warmupTime: 0, warmupIterations: 0 };

/** Lines of a take: the header without the number of frames, and the rows. */
interface Take {
  readonly head: (frames: number) => string;
  readonly rows: readonly string[];
}

function take(): Take {
  const lines = hasShared
    ? new TextDecoder().decode(sharedBytes('data/bvh/cmu-01_01.bvh')).trimEnd().split(/\r?\n/)
    : madeTake();
  const motion = lines.indexOf('MOTION');
  const hierarchy = lines.slice(0, motion).join('\n');
  return {
    head: (frames) => `${hierarchy}\nMOTION\nFrames: ${frames}\n${lines[motion + 2]}\n`,
    rows: lines.slice(motion + 3),
  };
}

function madeTake(): string[] {
  const lines = ['HIERARCHY'];
  const indent = (depth: number) => '  '.repeat(depth);
  for (let j = 0; j < 31; j++) {
    const channels = j === 0 ? '6 Xposition Yposition Zposition' : '3';
    lines.push(`${indent(j)}${j === 0 ? 'ROOT' : 'JOINT'} j${j}`, `${indent(j)}{`, `${indent(j + 1)}OFFSET 0 1 0`);
    lines.push(`${indent(j + 1)}CHANNELS ${channels} Zrotation Yrotation Xrotation`);
  }
  for (let j = 30; j >= 0; j--) lines.push(`${indent(j)}}`);
  lines.push('MOTION', 'Frames: 2000', 'Frame Time: .0083333');
  for (let f = 0; f < 2000; f++) {
    lines.push(Array.from({ length: 96 }, (_, k) => (90 * Math.sin((f * (k + 1)) / 500 + k)).toFixed(4)).join(' '));
  }
  return lines;
}

/** A take of this many bytes, with each number printed anew. */
function fileOf({ head, rows }: Take, size: number, print: (text: string) => string): Uint8Array {
  const text = rows.map((row) => row.trim().split(/\s+/).map(print).join(' ')).join('\n');
  const block = new TextEncoder().encode(`${text}\n`);
  const times = Math.max(1, Math.round(size / block.length));
  const start = new TextEncoder().encode(head(times * rows.length));
  const bytes = new Uint8Array(start.length + times * block.length);
  bytes.set(start);
  for (let i = 0; i < times; i++) bytes.set(block, start.length + i * block.length);
  return bytes;
}

function readOurs(bytes: Uint8Array): void {
  const reader = bvhReader('take.bvh', bytes.length);
  for (let from = 0; from < bytes.length; from += PIECE) reader.feed(bytes.subarray(from, from + PIECE));
  const { value, diagnostics } = reader.end();
  if (!value?.[0].take || diagnostics.length > 0) throw new Error(diagnostics[0]?.message ?? 'no take');
}

function readWithLoader(text: string): void {
  const [hierarchy, motion] = text.split('MOTION');
  const loader = new MEBvh();
  loader._parse_hierarchy(hierarchy);
  loader.parse_motion(motion);
  if (!loader.keyframes) throw new Error('no frames');
}

/** Milliseconds and bytes of each run, for the summary. */
const runs = new Map<string, { bytes: number; times: number[] }>();

/** Only one file is kept: they are large. Generated before timing (benches have no `beforeAll`). */
let held: { readonly file: string; readonly bytes: Uint8Array; readonly numbers: number } | undefined;

function made(file: (typeof FILES)[number]): { readonly bytes: Uint8Array; readonly numbers: number } {
  if (held?.file === file.name) return held;
  held = undefined;
  const bytes = fileOf(take(), SIZE, file.print);
  held = { file: file.name, bytes, numbers: countNumbers(bytes) };
  return held;
}

/** `prepare` returns what is timed, and how many bytes it reads. */
function timed(key: string, options: typeof LONG, prepare: () => { bytes: number; run: () => void }): void {
  let prepared: { bytes: number; run: () => void } | undefined;
  bench(
    key.slice(key.indexOf(':') + 2),
    () => {
      prepared ??= prepare();
      const start = performance.now();
      prepared.run();
      const time = performance.now() - start;
      const entry = runs.get(key) ?? { bytes: prepared.bytes, times: [] };
      entry.times.push(time);
      runs.set(key, entry);
    },
    options,
  );
}

/** Megabytes per second of the best run: other load can only slow it down. */
function speed(key: string): number {
  const entry = runs.get(key);
  if (!entry) return Number.NaN;
  return entry.bytes / 1e3 / Math.min(...entry.times);
}

const FILES = [
  { name: 'as recorded', print: (text: string) => text },
  { name: '15 digits', print: (text: string) => (Number(text) * 1.0000001234567).toPrecision(15) },
  { name: '16 and 17 digits', print: (text: string) => String(Number(text) * 1.0000001234567) },
] as const;

for (const file of FILES) {
  describe(`a .bvh of 100 MB, ${file.name}`, () => {
    timed(`${file.name}: bare loop`, LONG, () => {
      const { bytes, numbers } = made(file);
      return { bytes: bytes.length, run: () => void bareLoop(bytes, numbers) };
    });
    timed(`${file.name}: ours`, LONG, () => {
      const { bytes } = made(file);
      return { bytes: bytes.length, run: () => readOurs(bytes) };
    });
    if (file !== FILES[0]) return;
    timed(`${file.name}: bvh-loader`, LONGER, () => {
      const text = new TextDecoder().decode(made(file).bytes);
      return { bytes: text.length, run: () => readWithLoader(text) };
    });
    timed(`${file.name}: BVHLoader of three.js`, LONGEST, () => {
      const text = new TextDecoder().decode(made(file).bytes);
      return { bytes: text.length, run: () => void new BVHLoader().parse(text) };
    });
  });
}

afterAll(() => {
  held = undefined;
  const lines = [...runs.keys()].map((key) => {
    const bare = speed(`${key.slice(0, key.indexOf(':'))}: bare loop`);
    const own = speed(key);
    return `${key.padEnd(44)} ${own.toFixed(1).padStart(7)} MB/s   ${(bare / own).toFixed(2).padStart(6)} times the bare loop's time`;
  });
  console.log(`${lines.join('\n')}${hasShared ? '' : '\n(a take made here: the reference files are not at hand)'}`);
});
