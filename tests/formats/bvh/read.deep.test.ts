import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { bvhReader, readBvh } from '../../../src/formats/bvh/read.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import type { Capture } from '../../../src/model/files.ts';
import { expectEqual } from '../../helpers/equal.ts';
import { bytesOf, read, readInPieces, told } from '../read-in-pieces.ts';

const END = 'End Site\n{\nOFFSET 0 5 0\n}\n';
const hierarchy = (inner: string) => `HIERARCHY\nROOT Hips\n{\n${inner}}\n`;
/** Three channels. */
const THREE = hierarchy(`OFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n${END}`);
const motion = (rows: string, frames = 2, time = '0.1') => `MOTION\nFrames: ${frames}\nFrame Time: ${time}\n${rows}`;
const bvh = (text: string) => readBvh(text, 'take.bvh');
const rows = (text: string, frames = 2) => bvh(THREE + motion(text, frames));
/** The line of the first row in such a file. */
const ROW = 15;

function valuesOf({ value }: { readonly value?: readonly Capture[] }): number[] | undefined {
  const samples = value?.[0].take?.samples;
  return samples && Array.from(samples.values);
}

function jointsOf(text: string) {
  const { value, diagnostics } = bvh(text);
  expect(diagnostics).toEqual([]);
  return value?.flatMap(({ skeleton }) => skeleton.joints) ?? [];
}

describe('the hierarchy of a .bvh', () => {
  it('gives joints their channels in the order of the file, and a rest pose of offsets', () => {
    const [root, tail] = jointsOf(
      hierarchy(
        'OFFSET 1 2 3\nCHANNELS 4 Yrotation Zposition xposition Xrotation\nJOINT Tail\n{\nOFFSET 4 5 6\nCHANNELS 0\n}\n',
      ) + motion('0 0 0 0\n', 1),
    );
    expect(root).toMatchObject({
      ...{ name: 'Hips', parent: -1, offset: [1, 2, 3], pose: [0, 3, 1, 0] },
      motion: { kind: 'bvh', channels: ['ry', 'tz', 'tx', 'rx'], positions: 'replace' },
    });
    expect(root.limits).toHaveLength(4);
    expect(tail).toMatchObject({ name: 'Tail', parent: 0, offset: [4, 5, 6], pose: [], limits: [] });
    expect(root).not.toHaveProperty('endSites');
  });

  it.each([
    ['Arm L (upper) #2: b.c', 'Arm L (upper) #2: b.c'],
    ['  \t Größe 骨 \t', 'Größe 骨'],
    ['', ''],
    ['a}b', 'a}b'],
    ['JOINT', 'JOINT'],
    ['"quoted"', '"quoted"'],
  ])('takes the rest of the line for a name: %j', (written, name) => {
    const [root] = jointsOf(
      `HIERARCHY\nROOT ${written}\n{\nOFFSET 0 0 0\nCHANNELS 1 Zrotation\n}\n${motion('0\n', 1)}`,
    );
    expect(root.name).toBe(name);
  });

  it('ends a name at a brace on its line', () => {
    const [root, arm] = jointsOf(
      `HIERARCHY ROOT Left hand {OFFSET 0 0 0 CHANNELS 1 Zrotation JOINT b{OFFSET 0 0 0 CHANNELS 0 End Site { OFFSET 1 2 3 } } }\n${motion('0\n', 1)}`,
    );
    expect(root.name).toBe('Left hand');
    expect(arm).toMatchObject({ name: 'b', endSites: [[1, 2, 3]] });
  });

  it('the hierarchy of a .bvh keeps End Sites of every spelling, in their order', () => {
    const sites = 'End Site20\n{\nOFFSET 1 0 0\n}\nEnd Site { }\nEND SITE{OFFSET 3 0 0}\nEnd Site\n{\n}\n';
    const [root] = jointsOf(hierarchy(`OFFSET 0 0 0\nCHANNELS 1 Zrotation\n${sites}`) + motion('0\n', 1));
    expect(root.endSites).toEqual([
      [1, 0, 0],
      [0, 0, 0],
      [3, 0, 0],
      [0, 0, 0],
    ]);
  });

  it('reads channel names on several lines', () => {
    const [root] = jointsOf(hierarchy('OFFSET 0 0 0\nCHANNELS 2\nZrotation\nXrotation\n') + motion('0 0\n', 1));
    expect(root.motion).toMatchObject({ channels: ['rz', 'rx'] });
  });

  it.each([
    ['channels fewer than declared', 'OFFSET 0 0 0\nCHANNELS 2 Zrotation\n', 'channel-count 5:1'],
    ['channels more than declared', 'OFFSET 0 0 0\nCHANNELS 1 Zrotation Xrotation\n', 'channel-count 5:1'],
    ['an unknown channel', 'OFFSET 0 0 0\nCHANNELS 2 Zrotation Wrotation\n', 'channel-unknown 5:22'],
    ['a channel twice', 'OFFSET 0 0 0\nCHANNELS 2 Zrotation zRotation\n', 'channel-repeated 5:22'],
    ['OFFSET twice', 'OFFSET 0 0 0\nCHANNELS 0\nOFFSET 0 0 0\n', 'offset-repeated 6:1'],
    ['CHANNELS twice', 'OFFSET 0 0 0\nCHANNELS 0\nCHANNELS 0\n', 'channels-repeated 6:1'],
    ['an offset of two numbers', 'OFFSET 0 0\nCHANNELS 0\n', 'number-expected 5:1'],
    ['a word in an offset', 'OFFSET 0 0,5 0\nCHANNELS 0\n', 'not-a-number 4:10'],
    [
      'channels of an End Site',
      `OFFSET 0 0 0\nCHANNELS 0\nEnd Site\n{\nCHANNELS 1 Zrotation\n}\n`,
      'channels-unexpected 8:1',
    ],
    [
      'an End Site that stays open',
      'OFFSET 0 0 0\nCHANNELS 0\nEnd Site\n{\nJOINT a\n{\nOFFSET 0 0 0\nCHANNELS 0\n}\n',
      'brace-missing 8:1',
    ],
  ])('the hierarchy of a .bvh refuses %s, where it stands', (_, inner, expected) => {
    const result = bvh(hierarchy(inner) + motion('not even looked at\n'));
    expect(result.value).toBeUndefined();
    expect(told(result)).toEqual([`error ${expected}`]);
  });

  it.each([
    ['no HIERARCHY', 'ROOT x\n{\n}\n', 'hierarchy-missing 1:1'],
    ['an empty file', '', 'hierarchy-missing 1:1'],
    ['no root', 'HIERARCHY\nMOTION\n', 'joint-missing 2:1'],
    ['a joint outside', `${THREE}JOINT x\n{\n}\n`, 'keyword-unexpected 11:1'],
    ['no MOTION', THREE, 'motion-missing 11:1'],
    ['the end within a joint', 'HIERARCHY\nROOT x\n{\nOFFSET 0 0 0\n', 'brace-missing 5:1'],
    ['a second root within the first', 'HIERARCHY\nROOT x\n{\nROOT y\n{\n}\n', 'brace-missing 4:1'],
    ['no Frames', `${THREE}MOTION\nFrame Time: 1\n1 2 3\n`, 'frames-missing 13:1'],
    ['no Frame Time', `${THREE}MOTION\nFrames: 1\n1 2 3\n`, 'frame-time-missing 13:1'],
    ['no number of frames', `${THREE}MOTION\nFrames: many\nFrame Time: 1\n1 2 3\n`, 'not-a-number 12:9'],
  ])('the hierarchy of a .bvh refuses %s', (_, text, expected) => {
    const result = bvh(text);
    expect(result.value).toBeUndefined();
    expect(told(result)).toEqual([`error ${expected}`]);
  });

  it('warns of joints without OFFSET or CHANNELS, once for each kind', () => {
    const result = bvh(hierarchy('CHANNELS 1 Zrotation\nJOINT a { OFFSET 0 1 0 }\nJOINT b { }\n') + motion('0\n', 1));
    expect(told(result)).toEqual(['warning channels-missing 5:1', 'warning offset-missing 6:1']);
    expect(result.diagnostics[1].message).toContain('2 times');
    expect(result.value?.[0].skeleton.joints).toHaveLength(3);
  });

  it('names the place where an open brace was', () => {
    const { diagnostics } = bvh(`HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nMOTION\n`);
    expect(diagnostics[0].message).toContain('ROOT a, opened on line 2');
  });

  it('the hierarchy of a .bvh keeps names of any length, but says no more than their beginning', () => {
    const name = 'x'.repeat(100_000);
    const { value, diagnostics } = bvh(`HIERARCHY\nROOT ${name}\n{\nCHANNELS 0\n}\n${motion('', 0)}`);
    expect(value?.[0].skeleton.joints[0].name).toBe(name);
    expect(diagnostics[0].message).toMatch(/^Expected OFFSET in ROOT x{100}…, found none\.$/);
  });
});

describe('several roots in a .bvh', () => {
  const root = (name: string, channels: string) => `ROOT ${name}\n{\nOFFSET 0 0 0\nCHANNELS ${channels}\n}\n`;

  it('several roots in a .bvh are characters of their own, each with its columns of the rows', () => {
    const { value } = bvh(
      `HIERARCHY\n${root('a', '2 Zrotation Xposition')}${root('b', '0')}${root('a', '1 Xrotation')}${motion('1 2 3\n4 5 6\n')}`,
    );
    expect(value?.map(({ skeleton }) => skeleton.name)).toEqual(['take a', 'take b', 'take a 2']);
    expect(value?.map(({ take }) => take?.name)).toEqual(['take a', undefined, 'take a 2']);
    expect(value?.map(({ take }) => take?.samples && Array.from(take.samples.values))).toEqual([
      [1, 2, 4, 5],
      undefined,
      [3, 6],
    ]);
  });
});

describe('the samples of a .bvh', () => {
  it('the samples of a .bvh are the rows in degrees and file units, under a channel for each DOF', () => {
    const channels = '6 Xposition Yposition Zposition Zrotation Xrotation Yrotation';
    const { value } = bvh(hierarchy(`OFFSET 0 0 0\nCHANNELS ${channels}\n`) + motion('1 2 3 90 0 0\n4 5 6 0 0 -90\n'));
    const take = value?.[0].take;
    expect(take).toMatchObject({ name: 'take', range: [0, 0.1] });
    expect(take?.channels.map(({ kind }) => kind)).toEqual(new Array(6).fill('samples'));
    expect(take?.samples).toEqual({
      ...{ frameCount: 2, frameSeconds: 0.1, startSeconds: 0, firstChannel: 0, interpolation: 'linear' },
      values: Float64Array.of(1, 2, 3, 90, 0, 0, 4, 5, 6, 0, 0, -90),
      scales: Float64Array.of(1, 1, 1, RADIANS_PER_DEGREE, RADIANS_PER_DEGREE, RADIANS_PER_DEGREE),
    });
  });

  it('the samples of a .bvh come behind the root translation of a root without positions', () => {
    const take = rows('1 2 3\n4 5 6\n').value?.[0].take;
    expect(take?.samples?.firstChannel).toBe(3);
    expect(take?.channels).toHaveLength(6);
  });

  it.each(['Frames:2', 'Frames :2', 'frames: 2', 'Frames 2', 'FRAMES:\t2'])(
    'the samples of a .bvh are found after %j',
    (frames) => {
      const result = bvh(`${THREE}MOTION\n\n${frames}\nFrame Time: 0.1\n1 2 3\n4 5 6\n`);
      expect(result.diagnostics).toEqual([]);
      expect(valuesOf(result)).toEqual([1, 2, 3, 4, 5, 6]);
    },
  );

  it.each(['Frame Time:.5', 'Frame Time :0.5', 'FrameTime: 5e-1', 'frame  time 0.5', 'Frame Time:\t+0.5'])(
    'are spaced by %j',
    (time) => {
      const result = bvh(`${THREE}MOTION\nFrames: 1\n${time}\n1 2 3\n`);
      expect(result.diagnostics).toEqual([]);
      expect(result.value?.[0].take?.samples?.frameSeconds).toBe(0.5);
    },
  );

  it.each(['0', '-0.1', '1e-9', '1e300'])('cannot be %s s apart: 1/30 s, with a warning', (time) => {
    const result = bvh(THREE + motion('1 2 3\n4 5 6\n', 2, time));
    expect(told(result)).toEqual(['warning frame-time 13:13']);
    expect(result.diagnostics[0].assumed).toBe('used 1/30 s');
    expect(result.value?.[0].take?.samples?.frameSeconds).toBe(1 / 30);
  });

  it.each([
    ['no rows', '', 0],
    ['no rows where some are declared', '\n \n', 5],
    ['a part of a row', '1 2', 1],
  ])('the samples of a .bvh are none for %s: a skeleton without a take, and a warning', (_, text, frames) => {
    const result = rows(text, frames);
    expect(result.diagnostics.map((d) => `${d.severity} ${d.code}`)).toContain('warning frames-none');
    expect(result.value?.[0]).not.toHaveProperty('take');
    expect(result.value?.[0].skeleton.joints).toHaveLength(1);
  });

  it('the samples of a .bvh are none where there are no channels', () => {
    const result = bvh(hierarchy('OFFSET 0 0 0\nCHANNELS 0\n') + motion('1 2\n', 1));
    expect(result.value?.[0]).not.toHaveProperty('take');
    expect(result.diagnostics.map((d) => d.code)).toEqual(['frames-none', 'rows-end']);
  });
});

describe('rows of a .bvh', () => {
  it('decide how many frames there are, with a warning at what was declared', () => {
    for (const declared of [1, 3, 1e9, -1]) {
      const result = rows('1 2 3\n4 5 6\n', declared);
      expect(told(result)).toEqual(['warning count-mismatch 12:1']);
      expect(valuesOf(result)).toEqual([1, 2, 3, 4, 5, 6]);
    }
  });

  it('rows of a .bvh have no fraction of one: that is an error, as of every count', () => {
    const result = rows('1 2 3\n4 5 6\n', 2.5);
    expect(told(result)).toEqual(['error count-fractional 12:9']);
    expect(result.value).toBeUndefined();
  });

  it.each([
    ['over lines', '1\n2 3\n\n4 5\n\t6'],
    ['with blanks around', ' 1 2\t3 \n\n  4  5 6\t\n\n'],
    ['with CRLF', '1 2 3\r\n4 5 6\r\n'],
    ['with CR', '1 2 3\r4 5 6\r'],
    ['with CR CR LF', '1 2 3\r\r\n4 5 6\r\r\n'],
    ['without a last line end', '1 2 3\n4 5 6'],
    ['in every spelling', '+1 2. 3e0\n04 .5E+1 6.000'],
  ])('rows of a .bvh are read %s', (_, text) => {
    const result = rows(text);
    expect(result.diagnostics).toEqual([]);
    expect(valuesOf(result)).toEqual([1, 2, 3, 4, 5, 6]);
  });

  it('rows of a .bvh keep every bit, and the sign of 0', () => {
    expect(valuesOf(rows('0.1 -0 123.45678901234567\n1e-320 -1e308 0.30000000000000004\n'))).toEqual([
      ...[0.1, -0, 123.45678901234567, 1e-320, -1e308, 0.30000000000000004],
    ]);
  });

  it.each([
    ['a row is short', '1 2\n1 2 3\n', `row-incomplete ${ROW - 1}:1`],
    ['a row of several lines is short', '1 2 3\n 1\n2\n1 2 3\n', `row-incomplete ${ROW}:2`],
    ['a line is too long', '1 2 3\n1 2 3 4\n', `row-too-long ${ROW}:7`],
    ['two rows share a line', '1 2 3 1 2 3\n', `row-too-long ${ROW - 1}:7`],
    ['a word is among them', '1 x 3\n1 2 3\n', `not-a-number ${ROW - 1}:3`],
    ['a value is no number', '1 2 3\nnan 2 3\n', `not-a-number ${ROW}:1`],
    ['a value is too large', '1 2 3\n1 2 1e999\n', `number-too-large ${ROW}:5`],
    ['a brace is among them', '1 } 3\n', `not-a-number ${ROW - 1}:3`],
    ['words stand between rows', '1 2 3\nand then\n1 2 3\n', `row-expected ${ROW}:1`],
    ['Frames comes again', '1 2 3\nFrames: 2\n1 2 3\n', `row-expected ${ROW}:1`],
  ])('rows of a .bvh are refused when %s', (_, text, expected) => {
    const result = rows(text);
    expect(result.value).toBeUndefined();
    expect(told(result)).toEqual([`error ${expected}`]);
  });

  it('say how many numbers a short row has', () => {
    expect(rows('1\n2\n1 2 3\n').diagnostics[0].message).toContain('found 2; line 16');
  });

  it('all tell what is wrong with them', () => {
    expect(told(rows('1 x 3\n1 2 y\n'))).toEqual([`error not-a-number ${ROW - 1}:3`, `error not-a-number ${ROW}:5`]);
  });

  it.each([
    ['words', '1 2 3\n4 5 6\nthe end\n', ['rows-end 16:1']],
    ['words with numbers', '1 2 3\n4 5 6\n# 12 30 11\n', ['rows-end 16:1']],
    ['braces', '1 2 3\n4 5 6\n}\n', ['rows-end 16:1']],
    ['a row cut short', '1 2 3\n4 5 6\n7 8', ['row-incomplete 16:1']],
    ['a few numbers, then words', '1 2 3\n4 5 6\n7\n8\nend', ['row-incomplete 16:1', 'rows-end 18:1']],
    ['a control character', '1 2 3\n4 5 6\n\x1a', ['rows-end 16:1']],
  ])('end at %s, with a warning', (_, text, expected) => {
    const result = rows(text);
    expect(told(result)).toEqual(expected.map((each) => `warning ${each}`));
    expect(valuesOf(result)).toEqual([1, 2, 3, 4, 5, 6]);
  });

  it('rows of a .bvh never take more memory than they need, whatever is declared', () => {
    const text = THREE + motion('1.25 2.5 3.75\n'.repeat(200000), 1e9);
    const bytes = bytesOf(text);
    for (const byteLength of [bytes.length, undefined, 1, 1e12]) {
      const reader = bvhReader('take.bvh', byteLength);
      for (let from = 0; from < bytes.length; from += 65536) reader.feed(bytes.subarray(from, from + 65536));
      const values = reader.end().value?.[0].take?.samples?.values;
      expect(values).toHaveLength(600000);
      expect(values?.buffer.byteLength).toBeLessThan(1.15 * 8 * 600000);
    }
  });
});

/** Joints as a list of [depth, name, channels, End Sites], written in a style. */
const names = fc.stringMatching(/^[A-Za-z:.#()_]( ?[A-Za-z0-9:.#()_}-]){0,8}$/);
const number = fc.oneof(
  fc.double({ noNaN: true, noDefaultInfinity: true }),
  fc.double({ noNaN: true, min: -180, max: 180 }).map((x) => Math.round(x * 1e4) / 1e4),
  fc.integer({ min: -180, max: 180 }),
);
const vec3 = fc.tuple(number, number, number);
const CHANNELS = ['Xposition', 'Yposition', 'Zposition', 'Xrotation', 'Yrotation', 'Zrotation'];
const joint = fc.record({
  climb: fc.nat(3),
  name: names,
  offset: vec3,
  channels: fc.shuffledSubarray(CHANNELS),
  endSites: fc.array(vec3, { maxLength: 2 }),
});
const style = fc.record({
  line: fc.constantFrom('\n', '\r\n', '\r', '\r\r\n', '\n\n'),
  indent: fc.constantFrom('', ' ', '\t', '  \t'),
  blank: fc.constantFrom(' ', '\t', '   '),
  bom: fc.boolean(),
  breaks: fc.array(fc.boolean(), { minLength: 1, maxLength: 7 }),
});
const file = fc.record({
  joints: fc.array(joint, { minLength: 1, maxLength: 9 }),
  frames: fc.nat(5),
  numbers: fc.array(number, { minLength: 1, maxLength: 40 }),
  style,
  cuts: fc.array(fc.nat(), { maxLength: 8 }),
});
type MadeFile = typeof file extends fc.Arbitrary<infer T> ? T : never;

function written({ joints, frames, numbers, style }: MadeFile) {
  const { line, indent, blank, bom, breaks } = style;
  const lines: string[] = ['HIERARCHY'];
  const parents: number[] = [];
  const open: number[] = [];
  const put = (...words: (string | number)[]) => lines.push(indent.repeat(open.length) + words.map(spell).join(blank));
  const close = () => {
    open.pop();
    put('}');
  };
  joints.forEach(({ climb, name, offset, channels, endSites }, j) => {
    for (let up = Math.min(climb, open.length - 1); up > 0; up--) close();
    parents.push(open.at(-1) ?? -1);
    put(j === 0 ? 'ROOT' : 'JOINT', name);
    put('{');
    open.push(j);
    put('OFFSET', ...offset);
    put('CHANNELS', channels.length, ...channels);
    for (const end of endSites) put('End Site {', 'OFFSET', ...end, '}');
  });
  while (open.length > 0) close();
  put('MOTION');
  const width = joints.reduce((sum, { channels }) => sum + channels.length, 0);
  put('Frames:', frames);
  put('Frame Time:', 0.04);
  const values = Array.from({ length: frames * width }, (_, i) => numbers[i % numbers.length]);
  let text = lines.join(line) + line;
  values.forEach((value, i) => {
    const isLast = (i + 1) % width === 0;
    text += spell(value) + (isLast || breaks[i % breaks.length] ? line : blank);
  });
  return { bytes: bytesOf((bom ? '\uFEFF' : '') + text), parents, width, values };
}

function spell(value: string | number): string {
  return Object.is(value, -0) ? '-0' : String(value);
}

describe('any hierarchy and any rows', () => {
  it('any hierarchy and any rows come back as they were written, in whatever style and pieces', () => {
    const property = fc.property(file, (made) => {
      const { bytes, parents, width, values } = written(made);
      const { value, diagnostics } = readBvh(bytes, 'x.bvh');
      expect(diagnostics.map((d) => d.code)).toEqual(made.frames === 0 || width === 0 ? ['frames-none'] : []);
      const { skeleton, take } = value?.[0] ?? {};
      expect(skeleton?.joints.map((j) => j.parent)).toEqual(parents);
      expect(skeleton?.joints.map((j) => j.name)).toEqual(made.joints.map((j) => j.name));
      expect(skeleton?.joints.map((j) => j.offset)).toEqual(made.joints.map((j) => j.offset));
      expect(skeleton?.joints.map((j) => j.endSites ?? [])).toEqual(made.joints.map((j) => j.endSites));
      expect(skeleton?.joints.map((j) => j.pose.length)).toEqual(made.joints.map((j) => j.channels.length));
      expect(take?.samples && Array.from(take.samples.values)).toEqual(values.length > 0 ? values : undefined);
      const cuts = made.cuts.map((cut) => cut % (bytes.length + 1));
      expectEqual(readInPieces('x.bvh', bytes, cuts), read('x.bvh', bytes));
    });
    fc.assert(property, { numRuns: 120 });
  });

  it('are told of, whatever the size of the file is said to be, if no value before them is a number', () => {
    const text = THREE + motion('nan nan nan\nnan nan nan\n1 2 3\n', 1);
    const { diagnostics } = readBvh(text, 'take.bvh');
    expect(diagnostics).toHaveLength(6);
    for (const byteLength of [text.length, undefined, 1, 1e12]) {
      const reader = bvhReader('take.bvh', byteLength);
      reader.feed(bytesOf(text));
      expect(reader.end()).toEqual({ diagnostics });
    }
  });

  it('read the same in pieces when rows are damaged', () => {
    const part = fc.constantFrom('1', '2.5', '-3', 'x', 'nan', '}', '{', 'Frames:', '1e999', '\x1a');
    const gap = fc.constantFrom(' ', ' ', '\n', '\n', '\r\n', '\r', '\t', '\n\n', ' \n ');
    const property = fc.property(
      fc.array(fc.tuple(part, gap), { maxLength: 24 }),
      fc.array(fc.nat(120), { maxLength: 9 }),
      (parts, at) => {
        const head = THREE + motion('', 2);
        const bytes = bytesOf(head + parts.flat().join(''));
        const whole = read('x.bvh', bytes);
        const some = at.map((cut) => Math.min(head.length - 5 + cut, bytes.length));
        const all = Array.from({ length: bytes.length - head.length + 1 }, (_, i) => head.length + i);
        expectEqual(readInPieces('x.bvh', bytes, some), whole);
        expectEqual(readInPieces('x.bvh', bytes, all), whole);
        expect(whole.value === undefined).toBe(whole.diagnostics.some((d) => d.severity === 'error'));
      },
    );
    fc.assert(property, { numRuns: 250 });
  });

  it('hold for rows of numbers alone: what is read is whole lines of them, or refused', () => {
    const lines = fc.array(fc.array(fc.integer({ min: 0, max: 9 }), { maxLength: 5 }), { maxLength: 8 });
    const property = fc.property(lines, (all) => {
      const { value } = rows(all.map((line) => line.join(' ')).join('\n'));
      const read = value && (valuesOf({ value }) ?? []);
      // The rule as it is stated, line by line.
      let expected: number[] | undefined = [];
      let row: number[] = [];
      for (const line of all) {
        row = [...row, ...line];
        if (row.length > 3) {
          expected = undefined;
          break;
        }
        if (row.length < 3) continue;
        expected = [...expected, ...row];
        row = [];
      }
      expect(read).toEqual(expected);
    });
    fc.assert(property, { numRuns: 250 });
  });
});
