/** Keys that are so near that Blender takes them for one. */
import { expect, it } from 'vitest';
import { character, skeleton, takeOfValues } from '../../helpers/builders.ts';
import { glbOf, numbersOf } from '../../helpers/glb.ts';

it('the line to a step ends at a key just before it, so that it isn’t bent where both keys of the step become one', () => {
  const rest = takeOfValues(
    'step',
    Array.from({ length: 9 }, () => 0),
    [0, 3],
  );
  const step = {
    ...rest.channels[0],
    times: Float64Array.of(0, 1.5, 1.5, 3),
    values: Float64Array.of(0, 0.1, 0.9, 0.8),
    tangentsIn: { kinds: new Uint8Array(4).fill(1), slopes: new Float64Array(4) },
    tangentsOut: { kinds: new Uint8Array(4).fill(1), slopes: new Float64Array(4) },
  };
  const channels = rest.channels.map((each, i) => (i === 6 ? step : each));
  const made = glbOf(character({ skeleton: skeleton(2), takes: [{ ...rest, channels }], shownTake: 0 }));
  const seconds = made.json.animations?.[0].samplers.map(({ input }) => [...numbersOf(made, input)]) ?? [];
  const stepped = seconds.filter((times) => times.some((time, k) => k > 0 && time - times[k - 1] < 5e-4));
  expect(stepped.length).toBe(1);
  const [times] = stepped;
  const k = times.findIndex((time, n) => times[n + 1] - time < 5e-4);
  expect(times[k] - times[k - 1]).toBeGreaterThanOrEqual(5e-4);
  expect(times[k] - times[k - 1]).toBeLessThan(0.05);
});
