/** Opens what the address of the page asks for, and shows it as it says. */
import { showTake } from '../../edit/commands/characters.ts';
import { filesInQuery } from '../../io/address.ts';
import { fetchFiles } from '../../io/fetch-files.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Display } from '../../model/session.ts';
import type { Uses } from '../../ui/state/workbench.ts';
import type { SampleDisplay } from '../example-display.ts';
import { type BundledExample, fetchSample } from '../examples.ts';
import type { Opener } from '../opening.ts';
import { type Link, readLink } from './read-link.ts';

/** What a link acts on. */
export interface LinkParts extends Uses<'store' | 'transport' | 'messages' | 'viewport' | 'timeline' | 'settings'> {
  readonly opener: Opener;
  readonly sampleDisplay: SampleDisplay;
  /** All examples, the one that the page opens with first. */
  samples(): Promise<readonly BundledExample[]>;
  reducesMotion(): boolean;
  /** What the page opens with where the address names nothing. */
  openSample(display: Partial<Display>): Promise<readonly Diagnostic[]>;
}

/** @param query of the address: `?files=…` */
export async function openLink(parts: LinkParts, query: string): Promise<readonly Diagnostic[]> {
  const link = readLink(query);
  const wrong = [...link.wrong];
  const diagnostics = await opened(parts, filesInQuery(query), link, wrong);
  showAs(parts, link, wrong);
  if (wrong.length > 0) {
    parts.messages.note(`The link asks for what can’t be: ${wrong.join('; ')}.`, 'warning', 'until read');
  }
  return diagnostics;
}

async function opened(
  parts: LinkParts,
  files: readonly string[],
  { sample, display = {} }: Link,
  wrong: string[],
): Promise<readonly Diagnostic[]> {
  const { opener, sampleDisplay, openSample } = parts;
  if (files.length > 0) {
    sampleDisplay.show(display);
    return opener.open((signal) => fetchFiles(files, document.baseURI, signal));
  }
  if (sample === undefined) return openSample(display);
  const samples = await parts.samples();
  const found = samples.find(({ id }) => id === sample);
  if (!found) {
    wrong.push(`sample=${sample} (expected ${samples.map(({ id }) => id).join(', ')})`);
    return openSample(display);
  }
  // The one that the page opens with was read when it was built.
  if (found === samples[0]) return openSample(display);
  sampleDisplay.show({ ...found.shows, ...display });
  return opener.open((signal) => fetchSample(found, document.baseURI, signal));
}

function showAs(parts: LinkParts, link: Link, wrong: string[]): void {
  const { transport, viewport, timeline, settings, sampleDisplay } = parts;
  const { theme, panel, range, time, plays, camera } = link;
  if (theme) sampleDisplay.showTheme(theme);
  if (panel) {
    timeline.view.update((view) => ({ ...view, tab: panel, together: false }));
    settings.update((now) => ({ ...now, panels: { ...now.panels, timelineOpen: true } }));
  }
  showTakes(parts, link, wrong);
  select(parts, link, wrong);
  transport.update((now) => {
    const isPlaying = plays ?? (time === undefined ? now.playing : false);
    return {
      ...now,
      ...(range && { range, timeSeconds: range[0] }),
      ...(time !== undefined && { timeSeconds: time }),
      playing: isPlaying && !parts.reducesMotion(),
    };
  });
  if (camera) viewport.camera.view = camera;
}

/** Shows takes by their names, as part of opening: no step of undo. */
function showTakes({ store }: LinkParts, { takes }: Link, wrong: string[]): void {
  for (const name of takes) {
    const having = store.document.characters.filter((c) => c.takes.some((take) => take.name === name));
    if (having.length === 0) {
      const known = [...new Set(store.document.characters.flatMap((c) => c.takes.map((take) => take.name)))];
      wrong.push(`take=${name} (expected ${known.join(', ') || 'none, for there are no takes'})`);
    }
    for (const { id, takes: own } of having) {
      const take = own.findIndex((one) => one.name === name);
      store.amend(showTake.run(store.document, { characterId: id, take }));
    }
  }
}

function select({ store }: LinkParts, { joint }: Link, wrong: string[]): void {
  if (joint === undefined || selectJoint(store, joint)) return;
  wrong.push(`select=${joint} (expected the name of a joint)`);
}

/** Selects the first joint of that name; false if there is none. */
export function selectJoint(store: LinkParts['store'], name: string): boolean {
  for (const { id, skeleton } of store.document.characters) {
    const at = skeleton?.joints.findIndex((joint) => joint.name === name) ?? -1;
    if (at < 0) continue;
    store.select({ characterId: id, joint: at });
    return true;
  }
  return false;
}
