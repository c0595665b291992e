/** `OFFSET x y z rx ry rz`, as SOMA writes it. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { keyedTake } from '../../../src/edit/convert/keys-of-samples.ts';
import { skelForm } from '../../../src/edit/convert/skel-form.ts';
import { driverSource } from '../../../src/edit/follow/sources.ts';
import { bareCharacter } from '../../../src/evaluate/bare-character.ts';
import { framesFor, toBvhCapture } from '../../../src/evaluate/bvh-capture.ts';
import { provideRetargeting } from '../../../src/evaluate/retarget/driving.ts';
import { readBvh } from '../../../src/formats/bvh/read.ts';
import { writeSkel } from '../../../src/formats/skel/write.ts';
import type { Character } from '../../../src/model/document.ts';
import { writeBvh } from '../../helpers/bvh-text.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { bytesOf, read, readAsOpened, readInPieces, told } from '../read-in-pieces.ts';

provideRetargeting();

const CHANNELS = 'CHANNELS 3 Zrotation Xrotation Yrotation';
/** A root with a joint, whose numbers after OFFSET are given; the last is that of an End Site. */
const bvh = (root: string, joint: string, end: string) =>
  `HIERARCHY\nROOT hips\n{\n\tOFFSET ${root}\n\t${CHANNELS}\n\tJOINT knee\n\t{\n\t\tOFFSET ${joint}\n\t\t${CHANNELS}\n` +
  `\t\tEnd Site\n\t\t{\n\t\t\tOFFSET ${end}\n\t\t}\n\t}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n1 2 3 4 5 6\n`;
const SIX = bvh('0 1 0 10 20 30', '0 -0.5 0 -1.5 2e-3 0', '0 -0.25 0 7 8 9');

const rewritten = (text: string) => {
  const { value = [] } = readBvh(text, 'x.bvh');
  return writeBvh(value, 'x.bvh').text;
};

describe('six numbers after OFFSET', () => {
  it('are known: joints are those of the first three, and one info says so', () => {
    const { value, diagnostics } = readAsOpened('x.bvh', SIX);
    expect(diagnostics.map(({ severity, code, line, column }) => [severity, code, line, column])).toEqual([
      ['info', 'rest-orientation', 4, 15],
    ]);
    const plain = readBvh(bvh('0 1 0', '0 -0.5 0', '0 -0.25 0'), 'x.bvh').value ?? [];
    const captures = value?.kind === 'bvh' ? value.captures : [];
    const joints = captures[0].skeleton.joints;
    expect(joints.map(({ restAngles: _, ...joint }) => joint)).toEqual(plain[0].skeleton.joints);
    expect(joints.map(({ restAngles }) => restAngles)).toEqual([
      { own: [10, 20, 30] },
      { own: [-1.5, 0.002, 0], ends: [[7, 8, 9]] },
    ]);
    expect(captures[0].take).toEqual(plain[0].take);
  });

  it('are kept when they are written, and only where they were', () => {
    for (const text of [
      SIX,
      bvh('0 1 0', '0 1 0 0 0 0', '0 1 0'),
      bvh('0 1 0', '0 1 0', '0 1 0 1 2 3'),
      bvh('0 1 0', '0 1 0', '0 1 0'),
    ]) {
      const once = rewritten(text);
      const offsets = (all: string) =>
        (all.match(/OFFSET.*/g) ?? []).map((line) => line.split(' ').map((n) => Number(n) || n));
      expect(offsets(once)).toEqual(offsets(text));
      expect(rewritten(once)).toBe(once);
      expect(readBvh(once, 'x.bvh').value).toEqual(readBvh(text, 'x.bvh').value);
    }
  });

  it('are kept when the motion is sampled anew, but not of one that is retargeted to the skeleton', () => {
    const [{ skeleton, take }] = readBvh(SIX, 'x.bvh').value ?? [];
    if (!take) throw new Error('It has no motion.');
    const character = bareCharacter(skeleton, keyedTake(take, skeleton));
    const angles = (of: Character) =>
      toBvhCapture(of, framesFor(of, 20)).capture.skeleton.joints.map(({ restAngles }) => restAngles);
    expect(angles(character)).toEqual(skeleton.joints.map(({ restAngles }) => restAngles));
    const source = driverSource(character);
    if (!source) throw new Error('It drives nothing.');
    const driver = {
      sourceId: 'c2',
      source,
      pairs: [{ source: 0, target: 0 }],
      options: { reference: 'rest', plantsFeet: false } as const,
    };
    expect(angles({ ...character, driver })).toEqual([undefined, undefined]);
  });

  it('are left out of a .skel, which is said', () => {
    const [{ skeleton }] = readBvh(SIX, 'x.bvh').value ?? [];
    const { text, diagnostics } = writeSkel([skelForm(skeleton).skeleton]);
    expect(diagnostics.map(({ code }) => code)).toContain('rest-orientations-left-out');
    expect(text).not.toContain('10 20 30');
  });

  it.each([4, 5, 7])('%d numbers are an error on their line', (count) => {
    const numbers = [0, 1, 0, 4, 5, 6, 7].slice(0, count).join(' ');
    for (const [text, line] of [
      [bvh(numbers, '0 1 0', '0 1 0'), 4],
      [bvh('0 1 0 1 2 3', numbers, '0 1 0'), 8],
      [bvh('0 1 0 1 2 3', '0 1 0 1 2 3', numbers), 12],
    ] as const) {
      const { value, diagnostics } = readAsOpened('x.bvh', text.replaceAll('\n', '\r\n'));
      expect(value).toBeUndefined();
      const errors = diagnostics.filter(({ severity }) => severity === 'error');
      expect(errors.map((d) => [d.code, d.line])).toEqual([['offset-length', line]]);
      expect(errors[0].message).toContain(`found ${count}.`);
    }
  });

  it('numbers on the next line belong to no OFFSET', () => {
    expect(told(read('x.bvh', bvh('0 1 0\n1 2 3', '0 1 0', '0 1 0')))).toEqual(['warning number-unexpected 5:1']);
  });

  it('read the same in pieces', () => {
    const number = fc.constantFrom('1', '-2.5', 'nan', 'x', '1e-3', '\n', '\t');
    const numbers = fc.array(number, { maxLength: 5 }).map((all) => `0 1 0 ${all.join(' ')}`);
    const property = fc.property(numbers, numbers, numbers, fc.array(fc.nat(300)), (a, b, c, at) => {
      const bytes = bytesOf(bvh(a, b, c));
      const cuts = at.map((cut) => cut % (bytes.length + 1));
      expect(readInPieces('x.bvh', bytes, cuts)).toEqual(read('x.bvh', bytes));
    });
    fc.assert(property, { numRuns: 200 });
  });
});

describeShared('SOMA’s files', () => {
  it.each(['data/field/bvh-six-number-offsets.bvh', 'data/field/bvh-six-numbers-end-site.bvh'])(
    '%s is read without a warning, and written with all of its numbers',
    (path) => {
      const text = new TextDecoder().decode(sharedBytes(path));
      const { diagnostics } = readAsOpened(path, text);
      expect(diagnostics.map(({ severity }) => severity)).toEqual(['info']);
      const counts = (all: string) => (all.match(/OFFSET.*/g) ?? []).map((line) => line.trim().split(/\s+/).length);
      expect(counts(rewritten(text))).toEqual(counts(text));
    },
  );
});
