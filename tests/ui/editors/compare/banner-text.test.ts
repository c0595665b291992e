import { describe, expect, it } from 'vitest';
import { bannerText, numberText } from '../../../../src/ui/editors/compare/banner-text.ts';
import { describeShared } from '../../../helpers/shared.ts';
import { comparedCase } from './compare-cases.ts';

const WASP = ['cse169/wasp.skel', 'cse169/wasp_walk.anim'];
const NINE = ['synthetic/nine.skel', 'synthetic/nine.skin'];
const CURVES = ['../conformance/compare/curves.anim'];

describeShared('the banner of a comparison', () => {
  it('the banner names the first wrong joint, the mistake, and how much it explains', () => {
    const wrong = comparedCase(WASP, 'd008.txt', 1.5);
    expect(bannerText(wrong)).toEqual({
      tone: 'differs',
      text: 'First wrong: hip_03_r. You multiply Rx·Ry·Rz; it should be Rz·Ry·Rx. Explains all 23 joints.',
    });
    expect(bannerText({ ...wrong, isNamed: true }).text).toMatch(/^wasp: First wrong: hip_03_r\./);
  });

  it('the banner says which numbers a mistake explains, and that others have other causes', () => {
    const wrong = comparedCase(WASP, 'd008.txt', 1.5);
    const { result } = wrong;
    if (!result) throw new Error('Expected a result.');
    const { comparison } = result;
    const [cause] = comparison.causes;
    const causes = [
      { ...cause, about: { kinds: ['world' as const], files: ['anna.txt'] } },
      { ...cause, about: { kinds: ['channels' as const], files: ['dan.csv'] } },
    ];
    const frames = [...comparison.frames, ...comparison.frames];
    const partly = { ...wrong.state, result: { ...result, comparison: { ...comparison, causes, frames } } };
    expect(bannerText({ ...wrong, state: partly }).text).toContain(
      'In the world matrices of anna.txt: You multiply Rx·Ry·Rz; it should be Rz·Ry·Rx. Explains all 23 joints. 1 more cause',
    );
  });

  it('the banner offers to go to the compared time when another is shown', () => {
    const wrong = comparedCase(WASP, 'd008.txt', 1.5);
    const { text, goTo } = bannerText({ ...wrong, frame: -1, time: 0.2 });
    expect(goTo).toBe(1.5);
    expect(text).toBe(
      'Compared at 1.5 s. First wrong: hip_03_r. You multiply Rx·Ry·Rz; it should be Rz·Ry·Rx. Explains all 23 joints.',
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

  it('the banner does not guess where no mistake explains the numbers', () => {
    expect(bannerText(comparedCase(WASP, 'd039.json', 1.5)).text).toBe(
      'First wrong: hip_03_r. No known mistake, nor two together, explains it. ' +
        'Wrong by themselves: 1 joint; only inherited: 1.',
    );
  });

  it('the banner tells the problem of a dump that does not fit', () => {
    const misfit = bannerText(comparedCase(WASP, 'mine.txt', 0, 1e-4, '1 2 3\n'));
    expect(misfit).toMatchObject({ tone: 'trouble', problem: { line: 1, file: 'mine.txt' } });
    expect(misfit.text).toMatch(/^Not compared with wasp\. mine\.txt: Expected 12 or 16 numbers for each of 23 joints/);
  });

  it('the banner of several times tells which differs, and where the shown one agrees', () => {
    const right = comparedCase(WASP, 'd000.txt', 1.5);
    const wrong = comparedCase(WASP, 'd008.txt', 1.5);
    if (!right.result || !wrong.result) throw new Error('Nothing was compared.');
    const frames = [{ ...right.result.comparison.frames[0], time: 1 }, ...wrong.result.comparison.frames];
    const comparison = {
      ...wrong.result.comparison,
      frames,
      compared: { ...wrong.result.comparison.compared, world: 46 },
    };
    const result = { ...wrong.result, comparison };
    const both = { ...wrong, state: { ...wrong.state, result } };
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
