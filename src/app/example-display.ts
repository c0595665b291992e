/**
 * An example may switch on parts of the display, such as joint names if it is about them, and a link may ask for any.
 * That applies to what they open only: the switches are restored when another character is opened or the example is
 * removed, unless the user has changed them meanwhile, and they are not remembered for the next visit. They come back
 * with the example, when that opening is undone.
 */
import type { Store } from '../edit/store.ts';
import type { Display } from '../model/session.ts';
import type { Settings } from '../ui/state/settings.ts';
import type { Observable } from '../ui/widgets/observable.ts';

/** The switches that examples may ask for. */
export type SampleSwitches = Readonly<Partial<Pick<Display, 'names' | 'bones' | 'axes' | 'followRoot'>>>;

export class SampleDisplay {
  /** Values before the example changed them. */
  private changed: Partial<Display> = {};
  /** That of a link, and the one before it. */
  private theme: readonly (Settings['theme'] | undefined)[] = [];
  /** The example's characters, by id; undefined until they are loaded. */
  private own: ReadonlySet<string> | undefined;
  /** The example that was left last: its characters, all that were open with them, and its switches. */
  private left: { own: ReadonlySet<string>; open: ReadonlySet<string>; shown: Partial<Display> } | undefined;

  constructor(
    private readonly settings: Pick<Observable<Settings>, 'get' | 'update'>,
    store: Pick<Store, 'subscribe'>,
  ) {
    store.subscribe(({ document: { characters } }, { document: before }) => {
      if (characters === before.characters) return;
      const { left } = this;
      const now = new Set(characters.map(({ id }) => id));
      if (left && isSubset(left.own, now) && isSubset(now, left.open)) {
        this.show(left.shown);
        this.own = left.own;
        return;
      }
      if (Object.keys(this.changed).length === 0) return;
      if (!this.own) {
        this.own = new Set(characters.filter((c) => !before.characters.includes(c)).map((c) => c.id));
        return;
      }
      const { own } = this;
      const known = new Set(before.characters.map((c) => c.id));
      const isJoined = characters.some(({ id }) => !own.has(id) && !known.has(id));
      if (!isJoined && characters.some(({ id }) => own.has(id))) return;
      const { display } = settings.get();
      // Its keys are those of the display, typed as strings.
      const names = Object.keys(this.changed) as (keyof Display)[];
      const shown = Object.fromEntries(names.map((name) => [name, display[name]]));
      this.show();
      this.left = { own, open: known, shown };
    });
  }

  /** Called when an example is opened, before its characters are loaded, with what it asks for. */
  show(asked: Partial<Display> = {}): void {
    this.own = this.left = undefined;
    this.settings.update((now) => {
      const { display } = this.without(now);
      const isOther = ([name, value]: [string, unknown]) => (asked[name as keyof Display] ?? value) !== value;
      this.changed = Object.fromEntries(Object.entries(display).filter(isOther));
      return { ...now, display: { ...display, ...asked } };
    });
  }

  /** Shows the page in the theme of a link, until another one is chosen. */
  showTheme(shown: Settings['theme']): void {
    this.settings.update((now) => {
      this.theme = [shown, now.theme];
      return { ...now, theme: shown };
    });
  }

  /** The settings without what an example or a link changed, as they are to be remembered. */
  without(settings: Settings): Settings {
    const [shown, before] = this.theme;
    return {
      ...settings,
      // What the user has switched back is no longer in `changed`.
      display: { ...settings.display, ...this.changed },
      theme: (settings.theme === shown && before) || settings.theme,
    };
  }
}

function isSubset(some: ReadonlySet<string>, all: ReadonlySet<string>): boolean {
  return [...some].every((id) => all.has(id));
}
