/** Real takes put onto another humanoid, baked, and put back onto a copy of their own skeleton. */
import { expect, it } from 'vitest';
import { bakeRetarget } from '../../../src/edit/commands/retarget.ts';
import { type Character, findCharacter } from '../../../src/model/document.ts';
import { documentOf } from '../../helpers/builders.ts';
import { describeShared } from '../../helpers/shared.ts';
import { captured, HUMANOIDS, pairFit, retargeted } from './captures.ts';

/**
 * Degrees, medians over the take: each segment of arms and legs, 5° there and 5° back; feet, whose soles are found
 * twice; and hands, one of the others having no fingers.
 */
const LIMBS = 10;
const FEET = 25;
const HANDS = 30;
/** Metres, over the ground, in leg lengths. */
const SLIDE = 0.004;

/** Each of half of the humanoids in turn. */
const OTHERS = ['mixamo-names.bvh', 'xsens-armchair.bvh'];

function baked(driven: Character): Character {
  const found = findCharacter(bakeRetarget.run(documentOf(driven), { characterId: driven.id }), driven.id);
  if (!found) throw new Error(`${driven.id} is gone.`);
  return found;
}

describeShared('real takes on another humanoid and back', () => {
  it.each(HUMANOIDS)('%s on another humanoid and back points like itself', (file) => {
    const source = captured(file);
    const others = OTHERS.filter((name) => name !== file);
    const other = others[HUMANOIDS.indexOf(file) % others.length];
    const there = baked(retargeted(source, captured(other)));
    const fit = pairFit(retargeted(there, captured(file, `${file} copy`)), source);
    const told = `${file} on ${other} and back: ${JSON.stringify(fit)}`;
    expect(fit.limbs, told).toBeLessThan(LIMBS);
    expect(fit.feet, told).toBeLessThan(FEET);
    expect(fit.hands, told).toBeLessThan(HANDS);
    expect(fit.slide, told).toBeLessThan(fit.sourceSlide + SLIDE);
  });
});
