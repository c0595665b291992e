import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type Channel, keysOf, restChannel } from '../../../../src/model/takes/take.ts';
import { hitSheet, REACH, rowsTouched, type SheetKeys, sheetKeysInBox } from '../../../../src/ui/editors/dope/hit.ts';
import { HEAD, rowAt, rowTop, type Sheet } from '../../../../src/ui/editors/dope/sheet.ts';
import type { DopeRow } from '../../../../src/ui/editors/timeline/dope-rows.ts';
import { timeAt, timeX } from '../../../../src/ui/widgets/time/time-window.ts';
import { channel } from '../../builders.ts';
import { channels, sheets, someKeys } from './arbitrary.ts';

function row(key: string, ...of: number[]): DopeRow {
  return { key, kind: key === 'summary' ? 'summary' : 'joint', label: key, depth: 0, channels: of, expanded: false };
}

/** A summary, a row of the first half of the channels and one of the others, and a row for each. */
function rowsOf(all: readonly Channel[]): DopeRow[] {
  const of = [...all.keys()];
  const half = Math.ceil(of.length / 2);
  const groups = [row('summary', ...of), row('first', ...of.slice(0, half)), row('second', ...of.slice(half))];
  return [...groups, ...of.map((c) => row(`channel ${c}`, c))];
}

const sheet: Sheet = { width: 1000, height: 200, window: { from: 0, to: 1 }, rowHeight: 20, rowCount: 3, scrollTop: 0 };
/** Rows: the summary, one of channels 0 and 1, one of channel 2. */
const shown: SheetKeys = {
  rows: [row('summary', 0, 1, 2), row('hips', 0, 1), row('knee', 2)],
  channels: [channel(0.1, 0.5), channel(0.5), channel(0.5, 0.9)],
  offsetSeconds: 0,
};
const middle = (index: number) => rowTop(sheet, index) + 10;

describe('what is under the pointer', () => {
  it('a diamond means all keys of its row at that time', () => {
    expect(hitSheet(sheet, shown, 502, middle(1))).toEqual({
      kind: 'keys',
      row: 1,
      timeSeconds: 0.5,
      keys: [
        { channel: 0, indices: [1] },
        { channel: 1, indices: [0] },
      ],
    });
  });

  it('a diamond of the summary means a whole column', () => {
    const hit = hitSheet(sheet, shown, 500, middle(0));
    expect(hit.kind === 'keys' && hit.keys.map((k) => k.channel)).toEqual([0, 1, 2]);
  });

  it('beside its keys a row is hit, and nothing below the last row', () => {
    expect(hitSheet(sheet, shown, 500 + REACH + 1, middle(1))).toEqual({ kind: 'row', row: 1 });
    expect(hitSheet(sheet, shown, 500, middle(3))).toEqual({ kind: 'nothing' });
  });

  it('times are equal up to rounding', () => {
    const close: SheetKeys = { ...shown, channels: [channel(0.5), channel(0.5 - 1e-12), restChannel()] };
    const hit = hitSheet(sheet, close, 500, middle(1));
    expect(hit.kind === 'keys' && hit.keys).toHaveLength(2);
  });

  it('the character’s offset is subtracted from the take’s times', () => {
    const hit = hitSheet(sheet, { ...shown, offsetSeconds: 0.4 }, 100, middle(1));
    expect(hit.kind === 'keys' && hit.timeSeconds).toBeCloseTo(0.1, 12);
  });

  it('rows are hit at their scrolled position, below the summary', () => {
    const scrolled = { ...sheet, scrollTop: 20 };
    expect(hitSheet(scrolled, shown, 900, middle(1))).toMatchObject({ kind: 'keys', row: 2 });
    expect(hitSheet(scrolled, shown, 900, middle(0))).toMatchObject({ kind: 'keys', row: 0 });
  });
});

describe('the strip of the selection', () => {
  const selected: SheetKeys = { ...shown, selectedSpan: [0.2, 0.6] };
  const y = 4;
  const part = (x: number, keys = selected) => {
    const hit = hitSheet(sheet, keys, x, y);
    return hit.kind === 'strip' ? hit.part : hit.kind;
  };

  it('scales at its ends and moves in between', () => {
    expect([part(198), part(300), part(603)]).toEqual(['start', 'body', 'end']);
    expect([part(150), part(650)]).toEqual(['nothing', 'nothing']);
  });

  it('the strip of the selection keeps a middle part for moving if it is short', () => {
    expect(part(205, { ...shown, selectedSpan: [0.2, 0.21] })).toBe('body');
  });

  it('only moves keys of a single time, and is hidden without any', () => {
    expect(part(201, { ...shown, selectedSpan: [0.2, 0.2] })).toBe('body');
    expect(part(201, shown)).toBe('nothing');
  });
});

describe('a box', () => {
  const corner = fc.record({ x: fc.integer({ min: -50, max: 950 }), y: fc.integer({ min: HEAD, max: 320 }) });

  it('selects what a loop over all rows and keys finds in it', () => {
    fc.assert(
      fc.property(channels, sheets, corner, corner, fc.constantFrom(0, 0.25), (all, drawn, a, b, offsetSeconds) => {
        const rows = rowsOf(all);
        const scrolled = { ...drawn, rowCount: rows.length };
        const box = { x0: a.x, y0: a.y, x1: b.x, y1: b.y };
        const inBox = (c: number, i: number) => {
          const time = keysOf(all[c]).times[i];
          const from = timeAt(scrolled, Math.min(a.x, b.x)) + offsetSeconds;
          const to = timeAt(scrolled, Math.max(a.x, b.x)) + offsetSeconds;
          if (time < from || time > to) return false;
          return rows.some((r, index) => {
            if (index === 0 || !r.channels.includes(c)) return false;
            const at = rowTop(scrolled, index) + scrolled.rowHeight / 2;
            return at + REACH >= Math.min(a.y, b.y) && at - REACH <= Math.max(a.y, b.y);
          });
        };
        const found = sheetKeysInBox(scrolled, { rows, channels: all, offsetSeconds }, box, false);
        expect(found).toEqual(someKeys(all, inBox));
      }),
    );
  });

  it('selects whole columns if it started on the summary', () => {
    const found = sheetKeysInBox(sheet, shown, { x0: 400, y0: HEAD, x1: 600, y1: HEAD + 5 }, true);
    expect(found.map((k) => k.channel)).toEqual([0, 1, 2]);
  });

  it('selects nothing in a sheet without rows', () => {
    expect(
      sheetKeysInBox({ ...sheet, rowCount: 0 }, { ...shown, rows: [] }, { x0: 0, y0: 0, x1: 900, y1: 300 }, true),
    ).toEqual([]);
    expect(rowsTouched({ ...sheet, rowCount: 0 }, 0, 300)).toEqual([1, 1]);
  });
});

it('goes from a row to its height and back', () => {
  fc.assert(
    fc.property(sheets, fc.integer({ min: 0, max: 30 }), (drawn, index) => {
      const full = { ...drawn, rowCount: 31, height: 2000 };
      const y = rowTop(full, index) + full.rowHeight / 2;
      // A scrolled row is covered by the summary.
      expect(rowAt(full, y)).toBe(y < HEAD ? undefined : y < HEAD + full.rowHeight ? 0 : index);
    }),
  );
});

it('goes from a time to its pixel and back', () => {
  fc.assert(
    fc.property(sheets, fc.double({ min: -2, max: 4, noNaN: true }), (drawn, time) => {
      expect(timeAt(drawn, timeX(drawn, time))).toBeCloseTo(time, 9);
    }),
  );
});
