/**
 * An example may switch on parts of the display, such as joint names if it is about them. That applies to the example
 * only: the switches are restored when another character is opened or the example is removed, unless the user has
 * changed them meanwhile, and they are not remembered for the next visit.
 */
import type { Store } from '../edit/store.ts';
import type { Display } from '../model/session.ts';
import type { Settings } from '../ui/state/settings.ts';
import type { Observable } from '../ui/widgets/observable.ts';

const SWITCHES = ['names', 'bones', 'axes', 'followRoot'] as const;
/** The switches that examples may ask for. */
export type SampleSwitches = Readonly<Partial<Pick<Display, (typeof SWITCHES)[number]>>>;

export class SampleDisplay {
  /** Values before the example changed them. */
  private changed: SampleSwitches = {};
  /** The example's characters, by id; undefined until they are loaded. */
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

  /** Called when an example is opened, before its characters are loaded, with what it asks for. */
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

  /** The settings without what an example changed, as they are to be remembered. */
  without(settings: Settings): Settings {
    // What the user has switched back is no longer in `changed`.
    return { ...settings, display: { ...settings.display, ...this.changed } };
  }
}
