import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { countsOf, type LineHunk, lineNow } from '../../../../src/model/text-changes.ts';
import { ChangedRows } from '../../../../src/ui/editors/source/changed-rows.ts';

const hunk = (oldFrom: number, oldTo: number, newFrom: number, newTo: number) => ({ oldFrom, oldTo, newFrom, newTo });
/** Line 3 changed, 2 lines added behind line 4, lines 7 and 8 removed. */
const HUNKS = [hunk(3, 4, 3, 4), hunk(5, 5, 5, 7), hunk(7, 9, 9, 9)];

const rowsOf = (rows: ChangedRows) =>
  Array.from({ length: rows.count }, (_, i) => {
    const row = rows.at(i + 1);
    if (row.kind === 'line') return `${row.line}${row.change ? ` ${row.change}` : ''}`;
    return row.kind === 'old' ? `was ${row.line}` : `${row.count} removed`;
  });

/** Hunks with lines between them, and the number of lines of the new text. */
const changes = fc
  .array(fc.tuple(fc.integer({ min: 1, max: 4 }), fc.nat(3), fc.nat(3)), { maxLength: 6 })
  .map((parts) => {
    let [oldFrom, newFrom] = [1, 1];
    const hunks: LineHunk[] = [];
    for (const [same, old, now] of parts) {
      oldFrom += same;
      newFrom += same;
      if (old + now > 0) hunks.push(hunk(oldFrom, oldFrom + old, newFrom, newFrom + now));
      oldFrom += old;
      newFrom += now;
    }
    return { hunks, lines: newFrom };
  });

describe('the rows of a text with changes', () => {
  it('are its lines, and a row where lines were removed', () => {
    expect(rowsOf(new ChangedRows(10, HUNKS, new Set()))).toEqual([
      ...['1', '2', '3 changed', '4', '5 added', '6 added', '7', '8', '2 removed', '9', '10'],
    ]);
  });

  it('have what an open change was above it', () => {
    expect(rowsOf(new ChangedRows(10, HUNKS, new Set([0, 2])))).toEqual([
      ...['1', '2', 'was 3', '3 changed', '4', '5 added', '6 added', '7', '8', 'was 7', 'was 8', '9', '10'],
    ]);
  });

  it('hold every line once and in order, and every old line of what is open', () => {
    fc.assert(
      fc.property(changes, fc.infiniteStream(fc.boolean()), ({ hunks, lines }, isOpen) => {
        const open = new Set(hunks.flatMap((_, h) => (isOpen.next().value ? [h] : [])));
        const rows = new ChangedRows(lines, hunks, open);
        const all = Array.from({ length: rows.count }, (_, i) => rows.at(i + 1));
        const shown = all.flatMap((row) => (row.kind === 'line' ? [row.line] : []));
        expect(shown).toEqual(Array.from({ length: lines }, (_, i) => i + 1));
        const old = all.flatMap((row) => (row.kind === 'old' ? [row.line] : []));
        const meant = hunks.flatMap(({ oldFrom, oldTo }, h) =>
          open.has(h) ? Array.from({ length: oldTo - oldFrom }, (_, i) => oldFrom + i) : [],
        );
        expect(old).toEqual(meant);
        for (const line of shown) expect(rows.at(rows.rowOf(line))).toMatchObject({ kind: 'line', line });
        for (const h of hunks.keys()) expect(rows.at(rows.rowOfHunk(h)).hunk).toBe(h);
      }),
    );
  });

  it('lead from change to change and around, both ways', () => {
    const rows = new ChangedRows(10, HUNKS, new Set());
    const around = (step: 1 | -1) => {
      let row = 1;
      return Array.from({ length: 5 }, () => {
        const next = rows.hunkFrom(row, step) ?? -1;
        row = rows.rowOfHunk(next);
        return next;
      });
    };
    expect(around(1)).toEqual([0, 1, 2, 0, 1]);
    expect(around(-1)).toEqual([2, 1, 0, 2, 1]);
    expect(new ChangedRows(10, [], new Set()).hunkFrom(1, 1)).toBeUndefined();
  });
});

describe('the changes of a text', () => {
  it('the changes of a text move the lines below them', () => {
    expect([1, 3, 4, 5, 6, 7, 8, 9].map((line) => lineNow(HUNKS, line))).toEqual([
      ...[1, undefined, 4, 7, 8, undefined, undefined, 9],
    ]);
  });

  it('the changes of a text are counted by lines', () => {
    expect(countsOf(HUNKS)).toEqual({ changed: 1, added: 2, removed: 2 });
    expect(countsOf([hunk(1, 4, 1, 3)])).toEqual({ changed: 2, added: 0, removed: 1 });
  });
});
