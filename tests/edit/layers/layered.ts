/** Takes with layers for tests: of any channels, or written out. */
import fc from 'fast-check';
import { provideLayers } from '../../../src/evaluate/layers.ts';
import { arranged } from '../../../src/model/takes/layers.ts';
import { type Channel, type KeyedChannel, type Layer, restChannel, type Take } from '../../../src/model/takes/take.ts';
import { between, channels, channelsOrRest } from '../keys/channels.ts';

provideLayers();

/** A layer with these channels, additive and of weight 1 if nothing else is said. */
export function layerOf(own: readonly Channel[], more: Partial<Layer> = {}): Layer {
  return {
    ...{ name: 'layer', mode: 'additive', weight: 1, mute: false, solo: false, root: false, morphs: false },
    motion: { channels: own },
    ...more,
  };
}

/** A take of a base and layers; the base is active. */
export function layeredTake(
  base: readonly Channel[],
  list: readonly Layer[],
  range: readonly [number, number] = [0, 2],
): Take {
  const take: Take = { name: 'walk', range, channels: base };
  return arranged(take, take, list, -1);
}

const constant = fc.oneof(between(0, 1), fc.constantFrom(0, 1, 0.5, 2, -1));

/** A take of one channel under up to three layers. */
export function layeredTakes(weight: fc.Arbitrary<number | KeyedChannel> = constant): fc.Arbitrary<Take> {
  const layer = fc.record({
    channel: fc.option(channels(1, { steps: true, maxLength: 5 }), { nil: restChannel(), freq: 4 }),
    mode: fc.constantFrom('additive' as const, 'override' as const),
    weight,
    mute: fc.constantFrom(false, false, false, true),
    solo: fc.constantFrom(false, false, false, true),
  });
  return fc
    .tuple(channelsOrRest({ steps: true, maxLength: 5 }), fc.array(layer, { maxLength: 3 }))
    .map(([base, list]) =>
      layeredTake(
        [base],
        list.map(({ channel, ...more }, i) => layerOf([channel], { ...more, name: `layer ${i}` })),
        [-3, 4],
      ),
    );
}
