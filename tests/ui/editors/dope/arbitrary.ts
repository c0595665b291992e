/** Takes, rows, selections and sheets for the properties of the dope sheet. */
import fc from 'fast-check';
import type { ChannelKeys } from '../../../../src/model/session.ts';
import { type Channel, keysOf, restChannel } from '../../../../src/model/takes/take.ts';
import type { Sheet } from '../../../../src/ui/editors/dope/sheet.ts';
import { channel } from '../../builders.ts';

/** Times on a grid, so that keys often coincide, within and across channels; some are off it. */
const time = fc.oneof(
  fc.integer({ min: -20, max: 60 }).map((i) => i / 30),
  fc.double({ min: -1, max: 2, noNaN: true }),
);

export const channels: fc.Arbitrary<Channel[]> = fc.array(
  fc
    .array(time, { maxLength: 40 })
    .map((times): Channel => (times.length ? channel(...times.sort((a, b) => a - b)) : restChannel())),
  { minLength: 1, maxLength: 6 },
);

/** Some of the keys, by a coin flip each. */
export function someKeys(of: readonly Channel[], coin: (channel: number, index: number) => boolean): ChannelKeys[] {
  return of.map(keysOf).flatMap(({ times }, c) => {
    const indices = [...times.keys()].filter((i) => coin(c, i));
    return indices.length ? [{ channel: c, indices }] : [];
  });
}

export const sheets: fc.Arbitrary<Sheet> = fc
  .record({
    width: fc.integer({ min: 50, max: 900 }),
    height: fc.integer({ min: 60, max: 300 }),
    from: fc.double({ min: -1, max: 1, noNaN: true }),
    seconds: fc.double({ min: 0.01, max: 3, noNaN: true }),
    rowHeight: fc.constantFrom(16, 20, 32),
    scrollTop: fc.integer({ min: 0, max: 60 }),
  })
  .map(({ from, seconds, ...rest }) => ({ ...rest, rowCount: 0, window: { from, to: from + seconds } }));
