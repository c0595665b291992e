import fc from 'fast-check';
import { expect, it } from 'vitest';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../src/evaluate/curves.ts';
import { steppedTake } from '../../src/evaluate/stepped-take.ts';
import { evaluateMotion, takeMotion } from '../../src/evaluate/take-motion.ts';
import { withActive, withMotions } from '../../src/model/takes/layers.ts';
import type { Take } from '../../src/model/takes/take.ts';
import { channels } from '../edit/keys/channels.ts';
import { layeredTakes } from '../edit/layers/layered.ts';

it('a stepped channel has the value of its last key at or before any time, before the first that of the first', () => {
  const time = fc.integer({ min: -220, max: 220 }).map((tick) => tick / 16);
  fc.assert(
    fc.property(channels(1, { steps: true }), time, (channel, at) => {
      const take: Take = { name: 'x', range: [0, 1], channels: [channel] };
      const last = channel.times.findLastIndex((each) => each <= at);
      expect(evaluateChannel(compileTake(steppedTake(take)), 0, at)).toBe(channel.values[Math.max(0, last)]);
      expect(steppedTake(take)).toBe(steppedTake(take));
    }),
  );
});

it('all layers are stepped, whichever is active', () => {
  const time = fc.integer({ min: -80, max: 80 }).map((tick) => tick / 16);
  fc.assert(
    fc.property(layeredTakes(), time, (take, at) => {
      const shown = (one: Take) => {
        const out = new Float64Array(1);
        evaluateMotion(takeMotion(one, undefined), at, out, 1);
        return out[0];
      };
      const alone = withMotions(take, ({ channels }) => steppedTake({ name: 'x', range: [0, 1], channels }));
      for (const active of [-1, ...(take.layers?.list.keys() ?? [])])
        expect(shown(steppedTake(withActive(take, active)))).toBe(shown(alone));
    }),
  );
});
