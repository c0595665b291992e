/** What of the text in view is selected, at the current time, or clicked: between its lines and the document. */
import { baseName } from '../../../model/files.ts';
import { perObject } from '../../../model/per-object.ts';
import type { Selection } from '../../../model/session.ts';
import { linesOf, type SourceTarget, targetAt } from '../../../model/source-map.ts';
import type { Uses } from '../../state/workbench.ts';
import { count } from '../../widgets/numbers/number-text.ts';
import { frameThen, type Known, type Origins, originsIn, pickNow, targetsThen } from './as-opened.ts';
import { hasPartOfSelected, partsFrom } from './places.ts';
import type { TextInView } from './text-in-view.ts';

type Parts = Uses<'store' | 'files' | 'posing' | 'transport'>;
type Unsaved = ReturnType<Parts['files']['unsaved']['get']>;

const nameOf = (characterId: string, file: string) => `${characterId} ${file}`;
/** Of the files that differ from what characters have of them. */
const namesOf = perObject(
  (unsaved: Unsaved) => new Set(unsaved.map(({ characterId, name }) => nameOf(characterId ?? '', name))),
);

export class SelectedLines {
  private readonly known: Known;
  /** What was clicked in the text is in view already. */
  private isOwnPick = false;
  private seen: Selection | undefined;
  /** What was found last, and of what. */
  private last: { readonly of: readonly unknown[]; readonly origins: Origins } | undefined;

  constructor(
    private readonly wb: Parts,
    private readonly text: TextInView,
  ) {
    const { source, unsaved } = wb.files;
    this.known = {
      opened: (file) => source.opened(file),
      given: (path) => source.given(path),
      isUnsaved: (id, path) => namesOf(unsaved.get()).has(nameOf(id, baseName(path))),
    };
  }

  /** What was opened from the file, whatever text is shown. */
  get inFile(): Origins {
    const { opened } = this.text;
    return opened ? this.from(opened.path) : { state: 'same', origins: [] };
  }

  /** What is selected of the text in view, the one to be shown first. */
  get targets(): readonly SourceTarget[] {
    return this.selectedOf(this.here);
  }

  /** Whether a file holds something of what is selected. */
  hasSelected(path: string): boolean {
    const { document, selection } = this.wb.store;
    // Asked of each of thousands of files: few need a look at all characters.
    if (!hasPartOfSelected(document, selection, path)) return false;
    return this.selectedOf(this.from(path)).length > 0;
  }

  /** The line of the current time's frame, of a capture. */
  get frameLine(): number | undefined {
    const map = this.text.shown?.map;
    if (!map?.rows.some(({ of }) => of === 'frame')) return undefined;
    const origin = this.here.origins.find(({ file }) => file.hasTake);
    const frame = origin && frameThen(origin, this.wb.transport.get().timeSeconds);
    return frame && linesOf(map, frame)[0]?.from;
  }

  /** Whether the selection is another one than when this was last asked. */
  isAnew(): boolean {
    const { selection } = this.wb.store;
    const isNew = this.seen !== selection;
    this.seen = selection;
    return isNew;
  }

  /** Whether something was picked here since this was last asked. */
  takeOwnPick(): boolean {
    const { isOwnPick } = this;
    this.isOwnPick = false;
    return isOwnPick;
  }

  /** Selects what a line holds. Returns that in words, or why it selects nothing; undefined if it isn't known yet. */
  pick(line: number): { readonly isPicked: boolean; readonly text: string } | undefined {
    const map = this.text.shown?.map;
    if (!map) return undefined;
    const target = targetAt(map, line);
    const picked = target && pickNow(this.here.origins, target);
    if (picked && 'gone' in picked) {
      return { isPicked: false, text: `Line ${count(line)} was ${picked.gone}, which was changed or deleted.` };
    }
    if (!picked) {
      const text = target
        ? `Line ${count(line)} has nothing that is shown.`
        : `Line ${count(line)} has nothing to select.`;
      return { isPicked: false, text };
    }
    const { store, posing, transport } = this.wb;
    const { selection, dof, timeSeconds, text } = picked;
    this.isOwnPick = true;
    store.select(selection);
    if (dof) posing.chosenDof.set(dof);
    if (timeSeconds !== undefined) transport.update((now) => ({ ...now, timeSeconds, playing: false }));
    return { isPicked: true, text };
  }

  /** What the text in view holds. */
  private get here(): Origins {
    const { opened, changed } = this.text;
    if (!opened || !changed) return this.inFile;
    // The text is what is in the page.
    const parts = partsFrom(this.wb.store.document, opened.path);
    return { state: 'edited', origins: parts.map((now) => ({ now, file: now })) };
  }

  /** Found once for what asks in a frame: of thousands of characters it takes a while. */
  private from(path: string): Origins {
    const { store, files } = this.wb;
    const of = [path, store.document, files.source.given(path), files.unsaved.get()];
    if (this.last?.of.every((one, i) => one === of[i])) return this.last.origins;
    const origins = originsIn(store.document, path, this.known);
    this.last = { of, origins };
    return origins;
  }

  private selectedOf({ origins }: Origins): readonly SourceTarget[] {
    const { store, posing, transport } = this.wb;
    const chosen = posing.chosenDof.get();
    return origins.flatMap((origin) => {
      const frame = frameThen(origin, transport.get().timeSeconds);
      // Of lines in each frame, that of the current time is shown first.
      const inFrame = (target: SourceTarget) =>
        target.kind === 'bone' && frame?.kind === 'frame' ? [{ ...target, frame: frame.frame }, target] : [target];
      return targetsThen(origin, store.selection, chosen).flatMap(inFrame);
    });
  }
}
