/**
 * The mode in which a character opens: skeletons in the axis-angle form in FK, as in the program that form comes from;
 * others in Pose. A mode that someone has chosen stays, but Pose with the former.
 */
import type { Character } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';

/** Sets the mode for characters that are opened, until ended. */
export function followForm({ store, posing }: Uses<'store' | 'posing'>): () => void {
  let isFk = false;
  const look = (characters: readonly Character[], before: readonly Character[]) => {
    const known = new Set(before.map(({ id }) => id));
    const opened = characters.filter(({ id, skeleton }) => skeleton && !known.has(id));
    if (opened.length === 0) return;
    const mode = posing.mode.get();
    const isOfForm = opened.every(({ skeleton }) => skeleton?.form === 'axis-angle');
    if (isOfForm && mode === 'pose') posing.mode.set('fk');
    else if (!isOfForm && isFk && mode === 'fk') posing.mode.set('pose');
    isFk = isOfForm && posing.mode.get() === 'fk';
  };
  look(store.document.characters, []);
  const stops = [
    store.subscribe((now, before) => {
      if (now.document.characters !== before.document.characters)
        look(now.document.characters, before.document.characters);
    }),
    // FK that someone has come back to is chosen.
    posing.mode.subscribe((mode) => {
      if (mode !== 'fk') isFk = false;
    }),
  ];
  return () => stops.forEach((stop) => void stop());
}
