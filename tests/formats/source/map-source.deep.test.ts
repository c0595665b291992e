import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readAnim } from '../../../src/formats/anim/read.ts';
import { writeAnim } from '../../../src/formats/anim/write.ts';
import { readBvh } from '../../../src/formats/bvh/read.ts';
import { readMorph } from '../../../src/formats/morph/read.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import { readSkin } from '../../../src/formats/skin/read.ts';
import { mapSource, SourceMapper } from '../../../src/formats/source/map-source.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { isUnlimited } from '../../../src/model/skeleton/skeleton.ts';
import { linesOf, type SourceMap, type SourceTarget, targetAt } from '../../../src/model/source-map.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { bytesOf } from '../read-in-pieces.ts';
import { type RealFile, realFiles } from '../real-files.ts';

const linesIn = (text: string) => text.split(/\r*\n|\r/);

/** The numbers on the lines of a part, in order. */
function numbersAt(lines: readonly string[], map: SourceMap, target: SourceTarget): number[] {
  const text = linesOf(map, target).flatMap(({ from, to }) => lines.slice(from - 1, to));
  return text.flatMap((line) => line.split(/[\s{}]+/).filter((word) => /^[-+.]?\d|^[-+]\.\d/.test(word))).map(Number);
}

/** Some of many, first and last included. */
function some(count: number): number[] {
  const step = Math.max(1, Math.floor(count / 97));
  const all = Array.from({ length: Math.ceil(count / step) }, (_, i) => i * step);
  return count > 0 && all.at(-1) !== count - 1 ? [...all, count - 1] : all;
}

const files = (kind: string): readonly RealFile[] => realFiles().get(kind) ?? [];

describe('the lines of parts in whole files', () => {
  it('the lines of a joint have its offset, those of a DOF its limits', () => {
    for (const { name, text } of files('skel')) {
      const map = mapSource(bytesOf(text), name);
      const lines = linesIn(text);
      readSkel(text, name).value?.forEach(({ joints, form }, root) => {
        if (form) return;
        joints.forEach((joint, j) => {
          const own = linesOf(map, { kind: 'joint', root, joint: j });
          const words = own.flatMap(({ from, to }) => lines.slice(from - 1, to)).join(' ');
          expect(words, name).toContain(joint.name);
          if (/\boffset/i.test(words)) {
            const [, offset = ''] = /\boffset\s+(.*)/i.exec(words) ?? [];
            expect(offset.split(/\s+/).slice(0, 3).map(Number), name).toEqual([...joint.offset]);
          }
          dofsOf(joint.motion).forEach((dof, d) => {
            const { min, max } = joint.limits[d];
            if (isUnlimited(joint.limits[d])) return;
            const found = numbersAt(lines, map, { kind: 'joint', root, joint: j, dof: dof.name });
            expect(found, `${name} ${joint.name} ${dof.name}`).toEqual(expect.arrayContaining([min, max]));
          });
        });
      });
    }
  });

  it('each line of an axis-angle skeleton is its joint', () => {
    for (const { name, text } of files('axskel')) {
      const map = mapSource(bytesOf(text), name);
      const joints = readSkel(text, name).value?.[0].joints ?? [];
      joints.forEach((joint, j) => {
        expect(numbersAt(linesIn(text), map, { kind: 'joint', root: 0, joint: j }), name).toContain(joint.length);
      });
    }
  });

  it('the lines of a vertex have its position, normal and weights, those of a triangle its vertices', () => {
    for (const { name, text } of files('skin')) {
      const { value: skin } = readSkin(text, name);
      if (!skin) continue;
      const map = mapSource(bytesOf(text), name);
      const lines = linesIn(text);
      for (const vertex of some(skin.positions.length / 3)) {
        const found = numbersAt(lines, map, { kind: 'vertex', vertex });
        expect(found, `${name} ${vertex}`).toEqual(
          expect.arrayContaining([...skin.positions.subarray(3 * vertex, 3 * vertex + 3)]),
        );
        const { start, weights } = skin.attachments ?? { start: [0, 0], weights: [] };
        if (skin.attachments)
          expect(found, name).toEqual(expect.arrayContaining([...weights.slice(start[vertex], start[vertex + 1])]));
        if (skin.normals)
          expect(found).toEqual(expect.arrayContaining([...skin.normals.subarray(3 * vertex, 3 * vertex + 3)]));
      }
      for (const triangle of some(skin.triangles.length / 3)) {
        const own = [...skin.triangles.subarray(3 * triangle, 3 * triangle + 3)];
        expect(numbersAt(lines, map, { kind: 'triangle', triangle }), name).toEqual(own);
      }
      for (const joint of some(skin.bindings.length / 16)) {
        const matrix = [...skin.bindings.subarray(16 * joint, 16 * joint + 16)].filter((_, i) => i % 4 < 3);
        expect(numbersAt(lines, map, { kind: 'binding', joint }), name).toEqual(matrix);
      }
    }
  });

  it('the row of a replaced vertex begins with its index', () => {
    for (const { name, text } of files('morph')) {
      const morph = readMorph(text, name).value;
      const map = mapSource(bytesOf(text), name);
      for (const vertex of morph?.positions.indices ?? []) {
        expect(numbersAt(linesIn(text), map, { kind: 'vertex', vertex })[0], name).toBe(vertex);
      }
    }
  });

  it('the row of a key has its time and value', () => {
    for (const { name, text } of files('anim')) {
      const map = mapSource(bytesOf(text), name);
      const lines = linesIn(text);
      readAnim(text, name).value?.channels.forEach((channel, c) => {
        const { times, values } = keysOf(channel);
        for (const key of some(times.length)) {
          const found = numbersAt(lines, map, { kind: 'key', channel: c, key });
          expect(found, `${name} ${c} ${key}`).toEqual(expect.arrayContaining([times[key], values[key]]));
        }
      });
    }
  });

  it('the row of a frame has its samples, the lines of a joint of a capture its offset', () => {
    for (const { name, text } of files('bvh')) {
      const captures = readBvh(text, name).value ?? [];
      const map = mapSource(bytesOf(text), name);
      const lines = linesIn(text);
      const samples = captures[0]?.take?.samples;
      const width = captures.length === 1 && samples ? samples.values.length / samples.frameCount : 0;
      for (const frame of samples && width ? some(samples.frameCount) : []) {
        const row = [...(samples?.values.subarray(frame * width, (frame + 1) * width) ?? [])];
        expect(numbersAt(lines, map, { kind: 'frame', frame }), `${name} ${frame}`).toEqual(row);
      }
      captures.forEach(({ skeleton }, root) => {
        skeleton.joints.forEach(({ offset }, joint) => {
          const found = numbersAt(lines, map, { kind: 'joint', root, joint });
          expect(found, `${name} ${joint}`).toEqual(expect.arrayContaining([...offset]));
        });
      });
    }
  });

  it('the part at each line that a part has to itself is that part', () => {
    for (const kind of ['skin', 'anim', 'bvh', 'axskel']) {
      const [file] = files(kind);
      if (!file) continue;
      const { name, text } = file;
      const map = mapSource(bytesOf(text), name);
      for (const { of, lines } of map.rows) {
        for (const row of some(lines.count)) {
          const target = targetAt(map, lines.lines[0] + row);
          if (target?.kind !== of || lines.rows.length > 1) continue;
          expect(linesOf(map, target), name).toContainEqual({ from: lines.lines[0] + row, to: lines.lines[0] + row });
        }
      }
      for (const { target, from } of map.marks) {
        const at = targetAt(map, from);
        expect(at, `${name}:${from}`).toBeDefined();
        if (at?.kind === target.kind) expect(linesOf(map, at).some((l) => l.from <= from && from <= l.to)).toBe(true);
      }
    }
  });
});

describe('the lines of parts', () => {
  const skel = ['balljoint hips {', 'offset 0 1 0', 'rotxlimit -1 1', 'pose 0 0 0', 'hingejoint offset', '{'];
  const text = [...skel, 'limit r -0.5', '0.5 axis 0 0 1 }', 'boxmin 0 0 0', '}'].join('\n');
  const map = mapSource(bytesOf(text), 'a.skel');
  const joint = (joint: number, dof?: string): SourceTarget => ({
    kind: 'joint',
    root: 0,
    joint,
    ...(dof !== undefined && { dof }),
  });

  it('the lines of a joint are its own, around those of its children', () => {
    expect(linesOf(map, joint(0))).toEqual([
      { from: 1, to: 4 },
      { from: 9, to: 10 },
    ]);
    expect(linesOf(map, joint(1))).toEqual([{ from: 5, to: 8 }]);
  });

  it('a DOF has its limits and the pose, one without either the lines of its joint', () => {
    expect(linesOf(map, joint(0, 'rx'))).toEqual([{ from: 3, to: 4 }]);
    expect(linesOf(map, joint(0, 'ry'))).toEqual([{ from: 4, to: 4 }]);
    expect(linesOf(map, joint(1, 'r'))).toEqual([{ from: 7, to: 8 }]);
    expect(linesOf(mapSource(bytesOf('hingejoint a {\n}'), 'a.skel'), joint(0, 'r'))).toEqual([{ from: 1, to: 2 }]);
  });

  it('a line of limits is its DOF, a line of a child the child', () => {
    expect(targetAt(map, 3)).toEqual(joint(0, 'rx'));
    expect(targetAt(map, 6)).toEqual(joint(1));
    expect(targetAt(map, 9)).toEqual(joint(0));
    expect(targetAt(map, 11)).toBeUndefined();
  });

  it('an unknown word hides neither a joint after it nor the name of one', () => {
    const strange = 'balljoint a {\nmass 3 { balljoint no { } }\nbrand new\nballjoint b { }\n}';
    const found = mapSource(bytesOf(strange), 'a.skel');
    expect(linesOf(found, joint(1))).toEqual([{ from: 4, to: 4 }]);
    expect(found.marks.some(({ target }) => target.kind === 'joint' && target.joint === 2)).toBe(false);
  });

  it('keys out of order are found by their index after sorting', () => {
    const anim = 'animation {\nrange 0 2\nchannel {\nkeys 3 {\n2 20 flat flat\n0 0 flat flat\n1 10 flat flat\n}\n}\n}';
    const found = mapSource(bytesOf(anim), 'a.anim');
    expect(linesOf(found, { kind: 'key', channel: 0, key: 0 })).toEqual([{ from: 6, to: 6 }]);
    expect(targetAt(found, 5)).toEqual({ kind: 'key', channel: 0, key: 2 });
    expect(targetAt(found, 4)).toEqual({ kind: 'channel', channel: 0 });
  });

  it('triangles of several materials are numbered through the whole file', () => {
    const text = 'triangles 2 {\n0 1 2\n2 1 0\n}\nmaterial a { color 1 0 0 }\ntriangles 1 {\n1 1 2\n}';
    const found = mapSource(bytesOf(text), 'a.skin');
    const at = (triangle: number) => linesOf(found, { kind: 'triangle', triangle });
    expect([at(0), at(1), at(2)]).toEqual([2, 3, 7].map((line) => [{ from: line, to: line }]));
    expect(at(3)).toEqual([]);
    expect(targetAt(found, 7)).toEqual({ kind: 'triangle', triangle: 2 });
  });

  it('rows on one line, on several, and after blank lines are found', () => {
    const skin = 'positions 4 { 0 0 0 1 1 1\n2\n2 2\n\n3 3 3 }\ntriangles 1 {\n0 1 2\n}';
    const found = mapSource(bytesOf(skin), 'a.skin');
    const at = (vertex: number) => linesOf(found, { kind: 'vertex', vertex });
    expect([at(0), at(1)]).toEqual([[{ from: 1, to: 1 }], [{ from: 1, to: 1 }]]);
    expect(at(2)[0].from).toBe(2);
    expect(at(3)).toEqual([{ from: 5, to: 5 }]);
    expect(targetAt(found, 3)).toEqual({ kind: 'vertex', vertex: 2 });
    expect(targetAt(found, 5)).toEqual({ kind: 'vertex', vertex: 3 });
    expect(targetAt(found, 7)).toEqual({ kind: 'triangle', triangle: 0 });
  });

  it('a file with a row on each line needs one run for each block', () => {
    const rows = Array.from({ length: 1000 }, (_, i) => `${i} 0 0`).join('\n');
    const found = mapSource(bytesOf(`positions 1000 {\n${rows}\n}`), 'a.skin');
    expect(found.rows[0].lines).toMatchObject({ rows: Uint32Array.of(0), lines: Uint32Array.of(2), count: 1000 });
  });

  it('what is written is found again', () => {
    fc.assert(
      fc.property(fc.array(fc.integer({ min: 0, max: 5 }), { minLength: 1, maxLength: 6 }), (counts) => {
        const channels = counts.map((n) => {
          const tangents = { kinds: new Uint8Array(n), slopes: new Float64Array(n) };
          const times = Float64Array.from({ length: n }, (_, i) => i / 4);
          return {
            ...({ extrapolateIn: 'constant', extrapolateOut: 'cycle' } as const),
            ...(n ? ({ kind: 'keys', times, values: times } as const) : ({ kind: 'rest', value: 0 } as const)),
            ...(n ? { tangentsIn: tangents, tangentsOut: tangents } : {}),
          };
        });
        // Keys and resting channels have what their kind asks for.
        const take = { name: 'a', range: [0, 1], channels } as unknown as Parameters<typeof writeAnim>[0];
        const text = writeAnim(take).text;
        const found = mapSource(bytesOf(text), 'a.anim');
        counts.forEach((n, channel) => {
          for (let key = 0; key < n; key++) {
            const numbers = numbersAt(linesIn(text), found, { kind: 'key', channel, key });
            expect(numbers.slice(0, 2)).toEqual([key / 4, key / 4]);
          }
        });
      }),
      { numRuns: 30 },
    );
  });
});

describe('the index of lines', () => {
  const textOfLines = fc.array(fc.constantFrom('a', ' ', '\n', '\r', '\r\n', '\r\r\n', '{', '}', '12', 'é'), {
    maxLength: 60,
  });

  it('counts lines as messages do, however the file is cut', () => {
    fc.assert(
      fc.property(textOfLines, fc.integer({ min: 1, max: 9 }), (words, size) => {
        const bytes = bytesOf(words.join(''));
        const mapper = new SourceMapper('a.skel');
        for (let i = 0; i < bytes.length; i += size) mapper.feed(bytes.slice(i, i + size));
        const map = mapper.finish();
        expect(map).toEqual(mapSource(bytes, 'a.skel'));
        expect(map.index.count).toBe(linesIn(words.join('')).length);
        expect(map.index.bytes).toBe(bytes.length);
      }),
    );
  });

  it('has an entry for every 256 lines, and more where lines are long', () => {
    const short = mapSource(bytesOf('x\n'.repeat(1000)), 'a.txt').index;
    expect([...short.lines]).toEqual([1, 257, 513, 769]);
    expect([...short.offsets]).toEqual([0, 512, 1024, 1536]);
    const long = mapSource(bytesOf(`${'x'.repeat(70000)}\ny\nz`), 'a.txt').index;
    expect([...long.lines]).toEqual([1, 2]);
    expect([...long.offsets]).toEqual([0, 70001]);
  });
});
