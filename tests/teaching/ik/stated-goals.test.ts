/** Targets as programs print them, and what a comparison and the page say of them. */
import { expect, it } from 'vitest';
import { runToEnd } from '../../../src/evaluate/steps.ts';
import { readDump } from '../../../src/formats/dump/read.ts';
import { compare } from '../../../src/teaching/compare/compare.ts';
import { fitDumps } from '../../../src/teaching/dump/fit-dump.ts';
import { bannerText } from '../../../src/ui/editors/compare/banner-text.ts';
import { characterFrom } from '../lesson-files.ts';

const ARM = characterFrom(
  'arm.skel',
  'balljoint root { hingejoint elbow { offset 0 1 0 axis 0 0 1 fixedjoint hand_l { offset 0 1 0 } } }',
);
const ROWS = '0 0 0\n0 1 0\n1 1 0\n';
const compared = (text: string, name = 'mine.txt') => {
  const { value } = readDump(text, name);
  if (!value) throw new Error('It has no dump.');
  const { targets, diagnostics } = fitDumps(ARM, [{ fileName: name, dump: value }], undefined);
  return { comparison: targets && runToEnd(compare(ARM, targets)), targets, diagnostics };
};

it.each([
  'target hand_l 1 1 0',
  'Target: hand_l (1.0, 1.0, 0.0)',
  '# target of "hand_l" = vec3(1.000000, 1.000000, 0.000000)',
  'goal 2: 1 1 0',
  'IK target = [1 1 0] for joint hand_l',
  'target joint 2 (hand_l): 1, 1, 0',
  '// goal: hand_l -> {1.0f, 1.0f, 0.0f}',
  'target elbow@0,1,0 = 1 1 0',
  'targets hand_l\t1e0\t1e0\t0',
])('%s', (line) => {
  const { comparison, targets, diagnostics } = compared(`${line}\npositions\n${ROWS}`);
  expect(diagnostics).toEqual([]);
  expect(targets?.frames[0].solver?.goals).toMatchObject([{ target: [1, 1, 0] }]);
  expect(comparison).toMatchObject({ agrees: true, worst: 0 });
});

it.each([
  { targets: [{ joint: 'hand_l', position: [1, 1, 0] }] },
  { target: { joint: 2, position: { x: 1, y: 1, z: 0 } } },
  { goals: { hand_l: [1, 1, 0] } },
  { targets: [{ joint: 'elbow', point: [0, 1, 0], target: [1, 1, 0] }] },
])('JSON: %j', (stated) => {
  const positions = [
    [0, 0, 0],
    [0, 1, 0],
    [1, 1, 0],
  ];
  const { comparison, diagnostics } = compared(JSON.stringify({ ...stated, positions }), 'mine.json');
  expect(diagnostics).toEqual([]);
  expect(comparison).toMatchObject({ agrees: true, goals: [{ isPose: true }] });
});

it('the page tells whether the point is at its target', () => {
  const told = (line: string) => {
    const { comparison, targets } = compared(`${line}\npositions\n${ROWS}`);
    if (!comparison || !targets) throw new Error('It was not compared.');
    const result = { comparison, targets, character: ARM, tolerance: 1e-4 };
    const state = { dumps: [], newest: [], tolerance: 1e-4, phase: { kind: 'done' as const }, result };
    return bannerText({ state, character: ARM, frame: 0, time: undefined });
  };
  const right = told('target hand_l 1 1 0');
  expect(right.tone).toBe('agrees');
  expect(right.text).toContain('The origin of "hand_l" is at its target');
  const wrong = told('target hand_l 0 1.5 0.5');
  expect(wrong.tone).toBe('differs');
  expect(wrong.text).toContain('First wrong: hand_l. The origin of "hand_l" is not at its target, 1.22 away');
});

it('what is not judged is told in a sentence', () => {
  expect(compared(`target 1 1 0\npositions\n${ROWS}`).diagnostics).toMatchObject([{ code: 'target-joint', line: 1 }]);
  expect(compared(`target wrist 1 1 0\npositions\n${ROWS}`).diagnostics[0].message).toContain('found "wrist"');
});
