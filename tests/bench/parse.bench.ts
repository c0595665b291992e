/**
 * Readers against a bare loop that parses the same numbers into a Float32Array without checks, and against line
 * splitting as in three.js's loaders. Read the ratios, not the times. Goals: at most 1.5 times the bare loop for
 * numbers of up to 15 digits, and 3 times for 17.
 *
 * The inputs are generated in memory, the same in every run.
 */
import { bench, describe } from 'vitest';
import { animReader } from '../../src/formats/anim/read.ts';
import type { Reader } from '../../src/formats/reader.ts';
import { skinReader } from '../../src/formats/skin/read.ts';
import { bareLoop, countNumbers } from './bare-loop.ts';

/** Few and long: an iteration takes up to seconds. */
const LONG = { time: 0, iterations: 5, warmupTime: 0, warmupIterations: 2 };
const LONGEST = { time: 0, iterations: 2, warmupTime: 0, warmupIterations: 0 };
/** About the chunk size of a File's stream. */
const PIECE = 65536;

/** A linear congruential generator: the same numbers in every run. */
function random(): () => number {
  let state = 1;
  return () => {
    state = (Math.imul(state, 1103515245) + 12345) & 0x7fffffff;
    return state / 0x7fffffff;
  };
}

/** Vertices in a row of the mesh. */
const ROW = 300;

function skinBytes(vertices: number, print: (x: number) => string): Uint8Array {
  const next = random();
  const row = () => `\t${print(2 * next() - 1)} ${print(2 * next() - 1)} ${print(2 * next() - 1)}`;
  const weights = () => {
    const k = 1 + Math.floor(4 * next());
    let rest = 1;
    let line = `\t${k}`;
    for (let i = 0; i < k; i++) {
      const weight = i === k - 1 ? rest : rest * next();
      rest -= weight;
      line += ` ${Math.floor(24 * next())} ${print(weight)}`;
    }
    return line;
  };
  // Of neighbours, two by two along rows, as in a mesh: vertices at random would measure the memory's delay.
  let corner = 0;
  const triangle = () => {
    const at = (corner++ >> 1) % (vertices - ROW);
    return `\t${at} ${at + 1} ${at + ROW}`;
  };
  const matrix = () => `\tmatrix {\n\t\t1 0 0\n\t\t0 1 0\n\t\t0 0 1\n\t${row()}\n\t}`;
  return joined([
    ...block('positions', vertices, row),
    ...block('normals', vertices, row),
    ...block('skinweights', vertices, weights),
    ...block('triangles', 2 * vertices, triangle),
    ...block('bindings', 24, matrix),
  ]);
}

function animBytes(channels: number, keys: number): Uint8Array {
  const next = random();
  const words = ['flat', 'linear', 'smooth'];
  const tangent = () => (next() < 0.2 ? next().toFixed(4) : words[Math.floor(3 * next())]);
  const lines = [`animation {\n\trange 0 ${keys}\n\tnumchannels ${channels}`];
  for (let c = 0; c < channels; c++) {
    lines.push(`\tchannel {\n\t\textrapolate constant cycle\n\t\tkeys ${keys} {`);
    for (let k = 0; k < keys; k++) {
      lines.push(`\t\t\t${(k / 30).toFixed(6)} ${next().toFixed(6)} ${tangent()} ${tangent()}`);
    }
    lines.push('\t\t}\n\t}');
  }
  lines.push('}\n');
  return joined(lines);
}

function block(what: string, count: number, line: () => string): string[] {
  return [`${what} ${count} {`, ...Array.from({ length: count }, line), '}'];
}

/** Without one string of all lines. */
function joined(lines: readonly string[]): Uint8Array {
  const encoder = new TextEncoder();
  const pieces: Uint8Array[] = [];
  for (let i = 0; i < lines.length; i += 65536) {
    pieces.push(encoder.encode(`${lines.slice(i, i + 65536).join('\n')}\n`));
  }
  const all = new Uint8Array(pieces.reduce((sum, p) => sum + p.length, 0));
  let at = 0;
  for (const piece of pieces) {
    all.set(piece, at);
    at += piece.length;
  }
  return all;
}

/** As in three.js's loaders. */
function splitLines(bytes: Uint8Array): number {
  const lines = new TextDecoder().decode(bytes).split('\n');
  let sum = 0;
  for (const line of lines) {
    const words = line.trim().split(/\s+/);
    for (const word of words) sum += Number.parseFloat(word) || 0;
  }
  return sum;
}

function readInPieces(reader: Reader<unknown>, bytes: Uint8Array, size: number): void {
  for (let from = 0; from < bytes.length; from += size) reader.feed(bytes.subarray(from, from + size));
  const { value, diagnostics } = reader.end();
  if (!value) throw new Error(diagnostics[0]?.message);
}

const megabytes = (bytes: Uint8Array) => `${Math.round(bytes.length / 1e6)} MB`;

const SKINS = [
  { name: '6 decimals', vertices: 1_000_000, print: (x: number) => x.toFixed(6) },
  { name: '15 digits', vertices: 300_000, print: (x: number) => x.toPrecision(15) },
  { name: '16 and 17 digits', vertices: 300_000, print: (x: number) => String(x) },
] as const;

for (const { name, vertices, print } of SKINS) {
  const bytes = skinBytes(vertices, print);
  const count = countNumbers(bytes);
  describe(`.skin of ${vertices} vertices, ${name}, ${megabytes(bytes)}`, () => {
    bench('bare loop', () => void bareLoop(bytes, count), LONG);
    bench('reader, one piece', () => readInPieces(skinReader('x.skin'), bytes, bytes.length), LONG);
    bench('reader, pieces of 64 KB', () => readInPieces(skinReader('x.skin'), bytes, PIECE), LONG);
    bench('lines split', () => void splitLines(bytes), LONGEST);
  });
}

const take = animBytes(60, 10_000);
const takeNumbers = countNumbers(take);
describe(`.anim of 60 channels of 10,000 keys, ${megabytes(take)}`, () => {
  bench('bare loop', () => void bareLoop(take, takeNumbers), LONG);
  bench('reader, one piece', () => readInPieces(animReader('x.anim'), take, take.length), LONG);
  bench('reader, pieces of 64 KB', () => readInPieces(animReader('x.anim'), take, PIECE), LONG);
  bench('lines split', () => void splitLines(take), LONGEST);
});
