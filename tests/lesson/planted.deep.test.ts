/**
 * Every way to make every mistake, and random pairs, on all characters and in all kinds of numbers: how many are named.
 * Numbers have six digits, as programs print them.
 */
import { describe, expect, it } from 'vitest';
import { RIGHT_PROGRAM } from '../../src/lesson/program.ts';
import { hasShared } from '../helpers/shared.ts';
import { characterOf, OWN, SHARED } from './lesson-files.ts';
import { compared, kindsOf, namedIn, numbersBy, random, VARIANTS } from './planted.ts';

/** Of those that change a number. */
const SINGLES_NAMED = 0.99;
const PAIRS_NAMED = 0.97;
const PAIRS_EACH = 12;

const FILES: Readonly<Record<string, readonly string[]>> = { ...OWN, ...(hasShared && SHARED) };
const CHARACTERS = Object.entries(FILES).map(([name, files]) => ({ name, character: characterOf(...files) }));

describe('planted mistakes', () => {
  it('are named in nearly all cases, each way, on each character', () => {
    const missed: string[] = [];
    let wrong = 0;
    for (const { name, character } of CHARACTERS) {
      for (const kind of kindsOf(character)) {
        for (const { code, variant } of VARIANTS) {
          const found = compared(character, numbersBy(character, variant.apply(RIGHT_PROGRAM), kind));
          if (found.agrees) continue;
          wrong++;
          if (!namedIn(found).includes(code)) missed.push(`${name} ${kind} ${code} ${variant.detail}`);
        }
      }
    }
    expect(wrong).toBeGreaterThan(1000);
    expect(1 - missed.length / wrong, missed.join('\n')).toBeGreaterThanOrEqual(SINGLES_NAMED);
  });

  it('are named in pairs in nearly all cases', () => {
    const missed: string[] = [];
    let wrong = 0;
    const noise = random(7);
    const pick = () => VARIANTS[Math.floor(noise.next().value * VARIANTS.length)];
    for (const { name, character } of CHARACTERS) {
      for (const kind of kindsOf(character)) {
        for (let i = 0; i < PAIRS_EACH; i++) {
          const [a, b] = [pick(), pick()];
          if (a.code === b.code) continue;
          const program = b.variant.apply(a.variant.apply(RIGHT_PROGRAM));
          const found = compared(character, numbersBy(character, program, kind));
          if (found.agrees) continue;
          wrong++;
          // One mistake alone may do the same here.
          if (namedIn(found).length === 0)
            missed.push(`${name} ${kind} ${a.code}+${b.code}: ${a.variant.detail}; ${b.variant.detail}`);
        }
      }
    }
    expect(wrong).toBeGreaterThan(100);
    expect(1 - missed.length / wrong, missed.join('\n')).toBeGreaterThanOrEqual(PAIRS_NAMED);
  });

  it('are never named where a joint, a vertex or a channel is wrong for another reason', () => {
    const named: string[] = [];
    const noise = random(11);
    for (const { name, character } of CHARACTERS) {
      for (const kind of kindsOf(character)) {
        const targets = numbersBy(character, RIGHT_PROGRAM, kind);
        const values = kind === 'channels' ? targets.channels.values : targets.frames[0][kind];
        if (!values) continue;
        const at = Math.floor(noise.next().value * values.length);
        values[at] += 0.1 + noise.next().value;
        const found = compared(character, targets);
        expect(found.agrees, `${name} ${kind}`).toBe(false);
        if (found.causes.length > 0) named.push(`${name} ${kind} ${found.causes[0].code}`);
      }
    }
    expect(named).toEqual([]);
  });
});
