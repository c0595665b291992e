import { describe, expect, it } from 'vitest';
import { animFile, file, skeleton, skelFile } from '../../helpers/builders.ts';
import { only, open, walk } from './opening.ts';

describe('markers beside a take', () => {
  const step = { timeSeconds: 0.5, label: 'step' };
  const markers = (path: string) => file(path, { kind: 'markers', markers: [step] });
  const hero = [skelFile('hero.skel', skeleton()), animFile('hero_walk.anim', walk)];

  it('markers are given to the take that they are called after, in one drop or later', () => {
    expect(only(open([...hero, markers('hero_walk.markers.json')]).document).takes).toEqual([
      { ...walk, markers: [step] },
    ]);
    const { document } = open([markers('Hero_Walk.markers.json')], open(hero).document);
    expect(only(document).takes[0].markers).toEqual([step]);
    // The animation's own file has none.
    expect(only(open([animFile('hero_walk.anim', walk)], document).document).takes[0].markers).toEqual([step]);
  });

  it('markers of a take that is not open wait for it', () => {
    const { document, diagnostics } = open([markers('hero_walk.markers.json')]);
    expect(diagnostics[0].message).toContain('No open take');
    expect(only(open(hero, document).document).takes[0].markers).toEqual([step]);
  });
});
