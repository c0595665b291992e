import { describe, expect, it } from 'vitest';
import { CATALOGUE } from '../../src/teaching/catalogue/all.ts';
import type { Targets } from '../../src/teaching/compare/targets.ts';
import { RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { characterOf, OWN } from './lesson-files.ts';
import { compared, type Kind, numbersBy, together } from './planted.ts';

const CRAWLER = characterOf(...OWN.crawler);

/** What a program with these mistakes prints. */
function printed(kind: Kind, ...codes: readonly string[]): Targets {
  const program = codes.reduce((right, code) => {
    const mistake = CATALOGUE.find((each) => each.code === code);
    if (!mistake) throw new Error(`There is no mistake ${code}.`);
    return mistake.variants[0].apply(right);
  }, RIGHT_PROGRAM);
  return numbersBy(CRAWLER, program, kind);
}

/** As printed, with a wave that no mistake makes. */
function disturbed(kind: 'world' | 'vertices'): Targets {
  const targets = printed(kind);
  targets.frames[0][kind]?.forEach((value, i, all) => {
    if (i % 16 < 12 || kind === 'vertices') all[i] = value + 0.05 * Math.sin(12.9898 * i);
  });
  return targets;
}

/** In one dump. */
function inOne(...parts: readonly Targets[]): Targets {
  const { origins: _, ...all } = together(...parts);
  return all;
}

describe('independent mistakes', () => {
  it('of two dumps are both named, each with its dump and what it explains there', () => {
    const found = compared(
      CRAWLER,
      together(printed('world', 'rotation-sign'), printed('channels', 'tangents-unscaled')),
    );
    const channels = found.compared.channels;
    expect(found.causes).toMatchObject([
      { code: 'rotation-sign', about: { kinds: ['world'], files: ['0.txt'] }, explains: found.compared.world },
      { code: 'tangents-unscaled', about: { kinds: ['channels'], files: ['1.txt'] }, explains: channels, of: channels },
    ]);
    expect(found.unexplained).toBeUndefined();
  });

  it('of two dumps of one kind are both named', () => {
    const found = compared(
      CRAWLER,
      together(printed('world', 'rotation-sign'), printed('world', 'no-parent'), printed('world')),
    );
    expect(found.causes).toMatchObject([
      { code: 'rotation-sign', about: { files: ['0.txt'] } },
      { code: 'no-parent', about: { files: ['1.txt'] } },
    ]);
  });

  it('of two kinds in one dump are both named, where three mistakes together would explain it', () => {
    const parts = [
      printed('world', 'rotation-sign'),
      printed('vertices', 'rotation-sign', 'no-inverse-binding'),
      printed('channels', 'tangents-unscaled'),
    ];
    // The channels that the joints are made of are right, or the joints would show it too.
    const found = compared(CRAWLER, inOne(...parts));
    expect(found.causes).toMatchObject([
      { code: 'rotation-sign', about: { kinds: ['world'] } },
      { code: 'rotation-sign+no-inverse-binding', about: { kinds: ['vertices'] } },
      { code: 'tangents-unscaled', about: { kinds: ['channels'] } },
    ]);
  });

  it('are one where one mistake makes all, whatever the number of dumps', () => {
    const found = compared(
      CRAWLER,
      together(printed('world', 'rotation-sign'), printed('vertices', 'rotation-sign'), printed('channels')),
    );
    expect(found.causes.map(({ code, about }) => [code, about])).toEqual([['rotation-sign', undefined]]);
  });

  it('that make several dumps wrong are told once, with all of them', () => {
    const found = compared(
      CRAWLER,
      together(printed('world', 'no-parent'), disturbed('vertices'), printed('positions', 'no-parent')),
    );
    expect(found.causes.filter(({ code }) => code === 'no-parent')).toMatchObject([
      { about: { kinds: ['world', 'positions'], files: ['0.txt', '2.txt'] } },
    ]);
    expect(found.unexplained).toEqual({ kinds: ['vertices'], files: ['1.txt'] });
  });

  it('are never named for numbers that none explains', () => {
    const found = compared(CRAWLER, together(disturbed('world'), printed('vertices', 'no-inverse-binding')));
    expect(found.causes.map(({ code, about }) => [code, about?.files])).toEqual([['no-inverse-binding', ['1.txt']]]);
    expect(found.unexplained).toEqual({ kinds: ['world'], files: ['0.txt'] });
    expect(compared(CRAWLER, together(disturbed('world'), disturbed('vertices')))).toMatchObject({ causes: [] });
  });

  it('that would spoil right numbers of the same dump are no causes', () => {
    // Only a program that poses twice would print these; in two dumps they may be of two.
    const [right, wrong] = [printed('world'), printed('vertices', 'rotation-sign')];
    expect(compared(CRAWLER, inOne(right, wrong)).causes).toEqual([]);
    expect(compared(CRAWLER, together(right, wrong)).causes).toMatchObject([{ code: 'rotation-sign' }]);
  });
});
