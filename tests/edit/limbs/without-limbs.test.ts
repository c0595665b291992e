/** Characters without limbs are posed without the code of limbs. */
import { expect, it } from 'vitest';
import { keyLimb } from '../../../src/edit/commands/beside/limbs.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { provideLayers } from '../../../src/evaluate/layers.ts';
import { poseFrom, poseSource } from '../../../src/evaluate/pose.ts';
import { layerCode, provideLayerCode, withCurvesOfGoals } from '../../../src/model/takes/layer-code.ts';
import { HERO, heroOf, walking, withLegs } from './walker.ts';

it('a character without goals asks for nothing of limbs, however it is posed, and one with goals does', () => {
  const code = layerCode({ name: '' });
  let asked = 0;
  const counting = Object.fromEntries(
    Object.entries(code).map(([name, run]) => [
      name,
      (...args: unknown[]) => {
        asked++;
        return Reflect.apply(run, undefined, args);
      },
    ]),
  );
  const walk = walking();
  const limbed = withLegs();
  const planted = keyLimb.run(limbed, { ...HERO, timeSeconds: 0, limb: 0 });
  // The same functions, counted.
  provideLayerCode(counting as unknown as typeof code);
  for (const document of [walk, limbed]) {
    const hero = heroOf(document);
    const source = poseSource(hero);
    const pose = new Float64Array(source.count);
    for (let f = 0; f < 10; f++) poseFrom(source, f / 30, pose);
    expect(source.over).toBeUndefined();
    expect(withCurvesOfGoals(hero.takes[0], source.count)).toBe(hero.takes[0]);
    setDofs.run(document, { ...HERO, timeSeconds: 0, dofs: [{ index: 5, value: 0.1 }] });
  }
  expect(asked).toBe(0);
  poseSource(heroOf(planted));
  expect(asked).toBe(1);
  provideLayers();
});
