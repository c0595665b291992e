/**
 * A sample may ask for something to be drawn that the page does not draw as it is set: the names of joints, where they
 * are what it is about. That holds for the sample alone: it is put back when another character opens or the sample goes,
 * unless a person has switched it meanwhile, and it is not remembered for the next visit.
 */
import type { Store } from '../edit/store.ts';
import type { Display } from '../model/session.ts';
import type { Observable } from '../ui/kit/observable.ts';
import type { Settings } from '../ui/state/settings.ts';

const SWITCHES = ['names', 'bones', 'axes'] as const;
/** Those of the page's switches that samples may ask for. */
export type SampleSwitches = Readonly<Partial<Pick<Display, (typeof SWITCHES)[number]>>>;

export class SampleDisplay {
  /** What was switched for a sample, as it was before. */
  private changed: SampleSwitches = {};
  /** Its characters, by id; undefined until they are there. */
  private own: ReadonlySet<string> | undefined;

  constructor(
    private readonly settings: Pick<Observable<Settings>, 'update'>,
    store: Pick<Store, 'subscribe'>,
  ) {
    store.subscribe(({ document: { characters } }, { document: before }) => {
      if (characters === before.characters || Object.keys(this.changed).length === 0) return;
      if (!this.own) {
        this.own = new Set(characters.filter((c) => !before.characters.includes(c)).map((c) => c.id));
        return;
      }
      const { own } = this;
      const known = new Set(before.characters.map((c) => c.id));
      const isJoined = characters.some(({ id }) => !own.has(id) && !known.has(id));
      if (isJoined || !characters.some(({ id }) => own.has(id))) this.show();
    });
  }

  /** Called as each sample opens, before its characters are there, with what it asks for. */
  show(asked: SampleSwitches = {}): void {
    this.own = undefined;
    this.settings.update((now) => {
      const { display } = this.without(now);
      const wanted = SWITCHES.filter((name) => asked[name] !== undefined && asked[name] !== display[name]);
      this.changed = Object.fromEntries(wanted.map((name) => [name, display[name]]));
      const shown = Object.fromEntries(wanted.map((name) => [name, !display[name]]));
      return { ...now, display: { ...display, ...shown } };
    });
  }

  /** The settings without what was switched for a sample: as they are to be remembered. */
  without(settings: Settings): Settings {
    // What a person has switched back is as it was.
    return { ...settings, display: { ...settings.display, ...this.changed } };
  }
}
