import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { shownTake } from '../../../../src/model/document.ts';
import { MarkerDrag } from '../../../../src/ui/editors/timeline/markers/marker-drag.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

beforeEach(() => void vi.stubGlobal('window', new EventTarget()));
afterEach(() => void vi.unstubAllGlobals());

/** A take that starts 0.5 s late, with a span from 1 to 1.5 s. */
function marked() {
  const marked = { ...take([0, 2], channel(0, 1, 2)), markers: [{ label: 'step', timeSeconds: 1, endSeconds: 1.5 }] };
  const walker = character({ skeleton: skeleton(['hips', -1]), takes: [marked], timeOffsetSeconds: 0.5 });
  const { wb } = workbench(documentOf(walker));
  const span = () => {
    const [marker] = shownTake(wb.store.document.characters[0])?.markers ?? [];
    return [marker?.timeSeconds, marker?.endSeconds];
  };
  return { wb, span };
}

it('a marker that is dragged keeps its length, its end changes that, and each is one step', () => {
  const { wb, span } = marked();
  const drag = new MarkerDrag(wb, 0, false);
  for (const to of [0.2, 0.9, 0.75]) drag.move(to);
  drag.end();
  expect(span()).toEqual([1.25, 1.75]);
  const end = new MarkerDrag(wb, 0, true);
  end.move(0);
  expect(span()).toEqual([1.25, 1.25]);
  end.move(1.5);
  end.end();
  expect(span()).toEqual([1.25, 2]);
  wb.store.undo();
  expect(span()).toEqual([1.25, 1.75]);
  wb.store.undo();
  expect(span()).toEqual([1, 1.5]);
  expect(wb.store.undoLabel).toBeUndefined();
});

it('a marker goes back if its drag is cancelled, by Escape too', () => {
  const { wb, span } = marked();
  const { document } = wb.store;
  const drag = new MarkerDrag(wb, 0, false);
  drag.move(1);
  expect(span()).toEqual([1.5, 2]);
  drag.cancel();
  expect(wb.store.document).toBe(document);

  const another = new MarkerDrag(wb, 0, false);
  another.move(1);
  vi.stubGlobal('document', { activeElement: null });
  vi.stubGlobal('HTMLInputElement', class {});
  window.dispatchEvent(Object.assign(new Event('keydown'), { key: 'Escape' }));
  another.move(1.5);
  another.end();
  expect(wb.store.document).toBe(document);
  expect(wb.store.undoLabel).toBeUndefined();
});
