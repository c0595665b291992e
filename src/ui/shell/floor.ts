/** Draws the floor where characters stand (`edit/floor.ts`), and tells once of each opening whose floor isn't at 0. */
import { floorOf } from '../../edit/floor.ts';
import type { Character } from '../../model/document.ts';
import type { Uses } from '../state/workbench.ts';
import { atMostEvery } from '../widgets/frame.ts';
import { shown } from '../widgets/numbers/number-text.ts';

/** Until the returned function is called. */
export function followFloor(wb: Uses<'store' | 'settings' | 'viewport' | 'messages'>): () => void {
  let measured: readonly Character[] = [];
  let floor = 0;
  let told = '';
  const isOn = () => wb.settings.get().display.floorAtLowest;
  const draw = () => wb.viewport.setFloor(isOn() ? floor : 0);
  const tell = () => {
    const ids = measured.map(({ id }) => id).join();
    if (floor === 0 || ids === told || !isOn()) return;
    told = ids;
    const [{ name }, ...others] = measured;
    const whose = others.length > 0 ? 'Their origins are in their middle' : `${name}’s origin is in its middle`;
    const text = `${whose}, so the floor is at the lowest point, y = ${shown(Number(floor.toPrecision(3)))}.`;
    const offer = {
      label: 'Floor at 0',
      run: () => {
        wb.settings.update((s) => ({ ...s, display: { ...s.display, floorAtLowest: false } }));
        wb.messages.withdraw(text);
      },
    };
    wb.messages.suggest(text, [offer], () => !isOn() || floor === 0);
  };
  const follow = () => {
    const visible = wb.store.document.characters.filter((character) => !character.isHidden);
    // A pose or a key moves no floor.
    if (visible.length === measured.length && visible.every((one, i) => isAlike(one, measured[i]))) return;
    measured = visible;
    floor = floorOf(visible);
    draw();
    tell();
  };
  const stops = [
    // Not with the change: of thousands of characters measuring takes a while.
    wb.store.subscribe(atMostEvery(0, follow)),
    wb.settings.subscribe((now, before) => {
      if (now.display.floorAtLowest !== before.display.floorAtLowest) draw();
    }),
  ];
  follow();
  return () => {
    for (const stop of stops) stop();
  };
}

function isAlike(a: Character, b: Character): boolean {
  return (
    a.id === b.id &&
    a.placements === b.placements &&
    a.space === b.space &&
    a.skeleton === b.skeleton &&
    a.skins === b.skins &&
    a.shownTake === b.shownTake &&
    a.takes.length === b.takes.length
  );
}
