import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import type { Cause } from '../../../../src/teaching/search/found-causes.ts';
import { bannerText, explainsText, numberText } from '../../../../src/ui/editors/compare/banner-text.ts';
import { command } from '../../../helpers/command.ts';
import { describeShared, sharedBytes, sharedPath } from '../../../helpers/shared.ts';
import { comparedCase, comparedDumps, printedMatrices } from './compare-cases.ts';

const WASP = ['cse169/wasp.skel', 'cse169/wasp_walk.anim'];
const NINE = ['synthetic/nine.skel', 'synthetic/nine.skin'];
const CURVES = ['../conformance/compare/curves.anim'];

describeShared('the banner of a comparison', () => {
  it('the banner names the first wrong joint, the mistake, and how much it explains', () => {
    const wrong = comparedCase(WASP, 'd008.txt', 1.5);
    expect(bannerText(wrong)).toEqual({
      tone: 'differs',
      text: 'First wrong: hip_03_r. You multiply Rx·Ry·Rz; it should be Rz·Ry·Rx. Explains all 16 wrong joints.',
    });
    expect(bannerText({ ...wrong, isNamed: true }).text).toMatch(/^wasp: First wrong: hip_03_r\./);
  });

  it('the banner of several dumps is about that given last, with its own mistake, and says how many others there are', () => {
    const [anna, ben] = [{ name: 'd008.txt', time: 1.5 }, { name: 'd009.txt' }];
    const skinned = [...WASP, 'cse169/wasp.skin'];
    const ofBen = bannerText(comparedDumps(skinned, [anna, ben], 1.5)).text;
    expect(ofBen).toMatch(/^First wrong in d009\.txt at 0\.8 s: vertex \d+\. Your rotations turn the wrong way/);
    expect(ofBen).toContain('1 more cause in Compare.');
    const ofAnna = bannerText(comparedDumps(skinned, [ben, anna], 1.5)).text;
    expect(ofAnna).toMatch(/^First wrong in d008\.txt at 1\.5 s: hip_03_r\. You multiply Rx·Ry·Rz/);
    expect(ofAnna).toContain('Explains all 16 wrong joints.');
  });

  it('the banner says that the newest dump agrees, and what is wrong in others', () => {
    const wrong = { name: 'd008.txt', time: 1.5 };
    const right = { name: 'right.txt', bytes: printedMatrices(comparedCase(WASP, 'd008.txt', 1.5).character, [0.5]) };
    expect(bannerText(comparedDumps(WASP, [wrong, right], 1.5)).text).toMatch(
      /^right\.txt: all agree\. First wrong in d008\.txt at 1\.5 s: hip_03_r\./,
    );
  });

  it('the banner counts the items of the times that have them, and of all times', () => {
    const of = (frames: readonly number[], items: number): Cause => ({
      code: 'no-parent',
      detail: '',
      alternatives: [],
      sentences: [],
      formulas: [],
      explains: items,
      of: items,
      frames,
      residual: 0,
    });
    const { result } = comparedCase([...WASP, 'cse169/wasp.skin'], 'd009.txt', 1.5);
    if (!result) throw new Error('Nothing was compared.');
    // Beside vertices of one time, others are compared at another.
    expect(explainsText(of([1], 694), result)).toBe('Explains all 694 vertices.');
    expect(explainsText(of([0, 1], 694), result)).toBe('Explains all 347 vertices at all 2 times.');
    expect(explainsText({ ...of([0, 1], 694), explains: 600 }, result)).toBe(
      'Explains 600 of 694 vertices at 2 times.',
    );
  });

  it('the banner tells another cause of the same numbers, and counts several', () => {
    const wrong = comparedCase(WASP, 'd008.txt', 1.5);
    const { result } = wrong;
    if (!result) throw new Error('Nothing was compared.');
    const { comparison } = result;
    const [cause] = comparison.causes;
    const told = (causes: readonly Cause[]) =>
      bannerText({ ...wrong, state: { ...wrong.state, result: { ...result, comparison: { ...comparison, causes } } } })
        .text;
    expect(told([cause, { ...cause, code: 'other', sentences: ['You do another thing.'] }])).toContain(
      'Explains all 16 wrong joints. Equally: You do another thing.',
    );
    expect(told([{ ...cause, alternatives: ['z before x'] }])).toContain('Equally: z before x.');
    expect(
      told([
        { ...cause, alternatives: ['a', 'b'] },
        { ...cause, code: 'other' },
      ]),
    ).toContain('3 others explain it equally; see Compare.');
    expect(told([cause, { ...cause, code: 'part', explains: 20 }])).not.toMatch(/equally/i);
  });

  it('the banner offers to go to the compared time when another is shown', () => {
    const wrong = comparedCase(WASP, 'd008.txt', 1.5);
    const { text, goTo } = bannerText({ ...wrong, frame: -1, time: 0.2 });
    expect(goTo).toBe(1.5);
    expect(text).toBe(
      'Compared at 1.5 s. First wrong: hip_03_r. You multiply Rx·Ry·Rz; it should be Rz·Ry·Rx. Explains all 16 wrong joints.',
    );
  });

  it('the banner says what agrees', () => {
    expect(bannerText(comparedCase(WASP, 'd000.txt', 1.5))).toMatchObject({
      tone: 'agrees',
      text: expect.stringMatching(/^All agree: 23 world matrices at 1\.5 s, within 0\.0001\. The largest error is /),
    });
  });

  it('the banner names vertices, normals and samples of channels', () => {
    expect(bannerText(comparedCase(NINE, 'd025.txt')).text).toMatch(
      /^First wrong: vertex 0\. .* Explains all \d+ vert/,
    );
    const channels = bannerText(comparedCase(CURVES, 'd029.txt', 0));
    expect(channels.text).toMatch(/^First wrong: channel 0 at 0\.2727 s\. .* Explains all \d+ channels\.$/);
    expect(channels.goTo).toBe(0.2727);
  });

  it('the banner does not guess where no mistake explains the numbers, and says how they differ', () => {
    expect(bannerText(comparedCase(WASP, 'd039.json', 1.5)).text).toBe(
      'First wrong: hip_03_r. No known mistake, alone or with another, explains these numbers. ' +
        'What differs: Joint hip_03_r and all below it, in places alone, by a constant offset (0.2, 0, 0).',
    );
  });

  it('the banner says what is not explained, and how it differs, in the words of the command', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'marrow-'));
    try {
      const bytesOf = (name: string) => sharedBytes(`conformance/compare/${name}`);
      const { character } = comparedCase(WASP, 'd008.txt', 1.5);
      const dumps = {
        'd039.json': bytesOf('d039.json'),
        'd008.txt': bytesOf('d008.txt'),
        'moved.txt': printedMatrices(character, [0.5], 7),
      };
      for (const [name, bytes] of Object.entries(dumps)) writeFileSync(join(folder, name), bytes);
      const cases = [
        [['d039.json'], 2],
        [['d008.txt', 'moved.txt'], 2],
        [['d008.txt'], 0],
      ] as const;
      for (const [names, count] of cases) {
        const files = WASP.map((file) => sharedPath(`data/${file}`));
        const { out } = await command(['compare', ...files, ...names, '--time', '1.5'], folder);
        const given = names.map((name) => ({ name, bytes: dumps[name], time: 1.5 }));
        const { text } = bannerText(comparedDumps(WASP, given, 1.5));
        const lines = out.split('\n').filter((line) => /^(No known|What differs)/.test(line));
        expect(lines).toHaveLength(count);
        expect(text.slice(/No known|What differs|$/.exec(text)?.index)).toBe(lines.join(' '));
      }
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  });

  it('the banner tells the problem of a dump that does not fit', () => {
    const misfit = bannerText(comparedCase(WASP, 'mine.txt', 0, 1e-4, '1 2 3\n'));
    expect(misfit).toMatchObject({ tone: 'trouble', problem: { line: 1, file: 'mine.txt' } });
    expect(misfit.text).toMatch(/^Not compared with wasp\. mine\.txt: Expected 12 or 16 numbers for each of 23 joints/);
  });

  it('the banner of several times tells which differs, and where the shown one agrees', () => {
    const { character } = comparedCase(WASP, 'd000.txt', 1.5);
    const bytes = printedMatrices(character, [1]) + printedMatrices(character, [1.5], 7);
    const both = comparedCase(WASP, 'mine.txt', 1.5, 1e-4, bytes);
    expect(bannerText({ ...both, frame: 0, time: 1 })).toMatchObject({
      goTo: 1.5,
      text: expect.stringContaining('Agrees at 1 s. First wrong at 1.5 s: hip_03_r.'),
    });
    expect(bannerText({ ...both, frame: 1, time: 1.5 }).text).toMatch(/^First wrong at 1\.5 s: hip_03_r\./);
    expect(bannerText({ ...both, frame: -1, time: 3 })).toMatchObject({
      goTo: 1.5,
      text: expect.stringMatching(/^Compared at 2 times\. First wrong at 1\.5 s/),
    });
  });

  it('the banner says what is going on while there is no result', () => {
    const { state, ...subject } = comparedCase(WASP, 'd008.txt', 1.5);
    const { result: _, ...bare } = state;
    const at = (phase: typeof state.phase) => bannerText({ ...subject, state: { ...bare, phase } });
    expect(at({ kind: 'working', share: 0.25 })).toEqual({ tone: 'working', text: 'Comparing with wasp', share: 0.25 });
    expect(at({ kind: 'failed', message: 'The worker stopped.' }).text).toBe('Not compared. The worker stopped.');
    expect(at({ kind: 'cancelled' })).toMatchObject({ canRetry: true });
    expect(bannerText({ ...subject, state, character: undefined }).text).toContain('Undo restores it');
    // An earlier result stays while it is compared again.
    expect(bannerText({ ...subject, state: { ...state, phase: { kind: 'working', share: 0.5 } } })).toMatchObject({
      tone: 'differs',
      share: 0.5,
    });
  });
});

describe('errors in words', () => {
  it.each([
    [0.27123, '0.27'],
    [1234567, '1.2·10⁶'],
    [0, '0'],
    [1.14e-7, '1.1·10⁻⁷'],
    [0.0001, '0.0001'],
    [Number.POSITIVE_INFINITY, 'not a number'],
  ])('an error of %d is written %s', (value, text) => {
    expect(numberText(value)).toBe(text);
  });
});
