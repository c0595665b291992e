/** What else a space could be: nothing that leaves a character at a height that can hardly be. */
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { metresPerUnit, statedSpace } from '../../../src/evaluate/space/metres.ts';
import { spaceChoices } from '../../../src/evaluate/space/space-choices.ts';
import { guessedHeight, guessSpace } from '../../../src/evaluate/space/space-guess.ts';
import { personSkeleton, takeOfRoots } from '../../helpers/mocap.ts';

const anySize = fc.double({ min: -5, max: 5, noNaN: true }).map((log) => 10 ** log);

it('a stated unit that leaves a character at an unlikely height is offered others that don’t, whatever its size', () => {
  fc.assert(
    fc.property(anySize, fc.constantFrom(1, 0.01, 0.001, 0.0254), (size, metres) => {
      const skeleton = personSkeleton({ height: size });
      const take = takeOfRoots(skeleton, [[0, size / 2, 0]]);
      const { space } = statedSpace(metres);
      const choices = spaceChoices(skeleton, take, space);
      const { height, isPerson } = guessedHeight(skeleton, take, 'y', true);
      const isCredible = (tall: number) => (isPerson ? tall >= 0.4 && tall <= 4 : tall >= 0.01 && tall <= 30);
      expect(choices === undefined).toBe(isCredible(height * metres));
      if (!choices) return;
      expect(choices.others.length).toBeGreaterThan(0);
      for (const other of choices.others) expect(isCredible(height * metresPerUnit(other))).toBe(true);
    }),
  );
});

it('a guessed unit is offered no other that leaves a character at an unlikely height', () => {
  fc.assert(
    fc.property(anySize, (size) => {
      const skeleton = personSkeleton({ height: size });
      const take = takeOfRoots(skeleton, [[0, size / 2, 0]]);
      const space = guessSpace(skeleton, take);
      const { height } = guessedHeight(skeleton, take, 'y');
      for (const other of spaceChoices(skeleton, take, space)?.others ?? []) {
        if (other.up !== space.up) continue;
        const tall = height * metresPerUnit(other);
        expect([tall >= 0.01, tall <= 30]).toEqual([true, true]);
      }
    }),
  );
});
