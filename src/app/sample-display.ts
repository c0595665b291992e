/**
 * A sample may ask for something to be drawn that the page does not draw as it is set: the names of joints, where they
 * are what it is about. That is put back when the next sample opens, unless a person has switched it meanwhile.
 */
import type { Display } from '../model/session.ts';
import type { Observable } from '../ui/observable.ts';
import type { Settings } from '../ui/settings.ts';

const SWITCHES = ['names', 'bones', 'axes'] as const;
/** Those of the page's switches that samples may ask for. */
export type SampleSwitches = Readonly<Partial<Pick<Display, (typeof SWITCHES)[number]>>>;

/** Gives what is called as each sample opens, with what it asks for. */
export function sampleDisplay(settings: Pick<Observable<Settings>, 'update'>): (shows?: SampleSwitches) => void {
  let changed: SampleSwitches = {};
  return (shows = {}) => {
    settings.update((now) => {
      const display: { -readonly [K in keyof Display]: Display[K] } = { ...now.display };
      for (const name of SWITCHES) if (changed[name] === display[name]) display[name] = !display[name];
      const asked = SWITCHES.filter((name) => shows[name] !== undefined && shows[name] !== display[name]);
      changed = Object.fromEntries(asked.map((name) => [name, !display[name]]));
      return { ...now, display: { ...display, ...changed } };
    });
  };
}
