/** *Save > Copy link*: an address that opens what is shown, for files that came from links or examples. */
import { wordsOf } from '../../model/display-words.ts';
import { rangeOfTakes } from '../../model/document.ts';
import { firstTake } from '../../model/takes/moving.ts';
import type { Messages } from '../../ui/state/messages.ts';
import type { Uses } from '../../ui/state/workbench.ts';
import { BLOCKED, copyText } from '../../ui/widgets/clipboard.ts';
import { numbersOf } from '../../view/camera/view-numbers.ts';
import type { DiskHandles } from '../disk-handles.ts';
import type { BundledExample } from '../examples.ts';
import type { Unsaved } from '../unsaved.ts';
import { numberText } from './number-text.ts';

/** What a link is made of. */
export interface CopiedParts extends Uses<'store' | 'timeline' | 'settings' | 'viewport' | 'transport'> {
  readonly messages: Pick<Messages, 'note'>;
  readonly handles: DiskHandles;
  readonly samples: Promise<readonly BundledExample[]>;
  readonly unsaved: Unsaved;
}

/** Copies the link, and says what it has not. */
export async function copyLink(parts: CopiedParts): Promise<void> {
  const { store, messages, handles, unsaved } = parts;
  const { characters } = store.document;
  const paths = [...new Set(characters.flatMap(({ sources }) => sources.map(({ path }) => path)))];
  const missing = paths.filter((path) => handles.at(path)?.address === undefined);
  if (missing.length > 0 || paths.length === 0) {
    const what = missing.length > 0 ? `${missing.slice(0, MAX_NAMED).join(', ')} did not` : 'this did not';
    const more = missing.length > MAX_NAMED ? ` (nor did ${missing.length - MAX_NAMED} more)` : '';
    const text = `A link can only have what came from an address or an example, and ${what}${more}.`;
    return messages.note(text, 'warning');
  }
  const addresses = [...new Set(paths.flatMap((path) => handles.at(path)?.address ?? []))];
  const query = queryOf(parts, await parts.samples, addresses);
  if (!(await copyText(new URL(`?${query}`, pageOf(location.href)).href))) return messages.note(BLOCKED, 'warning');
  const isChanged = unsaved.current().length > 0 || characters.some(({ driver }) => driver);
  messages.note(isChanged ? 'Link copied, without the changes since its files were opened.' : 'Link copied.');
}

const MAX_NAMED = 3;

/** The page's address without a query. */
function pageOf(href: string): string {
  return href.replace(/[?#].*$/, '');
}

function queryOf(parts: CopiedParts, samples: readonly BundledExample[], addresses: readonly string[]): string {
  const { store, viewport, transport, settings, timeline } = parts;
  const { document: shown, selection } = store;
  const { timeSeconds, playing, range } = transport.get();
  const { display, panels } = settings.get();
  // As it is: the other page may follow another system.
  const { theme } = document.documentElement.dataset;
  const sample = samples.find(({ files }) => isSame(files.map(sampleAddress), addresses));
  const takes = shown.characters.flatMap(({ takes: own, shownTake }) =>
    own[shownTake] && shownTake !== firstTake(own) ? [own[shownTake].name] : [],
  );
  const { joints } = shown.characters.find(({ id }) => id === selection.characterId)?.skeleton ?? {};
  const joint = selection.joint === undefined ? undefined : joints?.[selection.joint]?.name;
  const all = rangeOfTakes(shown);
  const isWhole = all === undefined || (all[0] === range[0] && all[1] === range[1]);
  const said: readonly (readonly [name: string, values: readonly string[]])[] = [
    sample ? ['sample', [sample.id]] : ['files', addresses.map(shortAddress)],
    ['take', takes],
    ['range', isWhole ? [] : range.map(numberText)],
    ['time', [numberText(timeSeconds)]],
    ['play', playing ? ['1'] : []],
    ['select', joint ? [joint] : []],
    ['camera', numbersOf(viewport.camera.view).map(numberText)],
    ['show', wordsOf(display)],
    ['panel', panels.timelineOpen ? [timeline.view.get().tab] : []],
    ['theme', theme ? [theme] : []],
  ];
  return said
    .flatMap(([name, values]) => (values.length ? [`${name}=${values.map(encoded).join(',')}`] : []))
    .join('&');
}

/** Readable where it may be: only what ends a value is encoded. */
function encoded(value: string): string {
  return encodeURIComponent(value).replaceAll('%2F', '/').replaceAll('%3A', ':');
}

function sampleAddress(name: string): string {
  return new URL(`samples/${name}`, document.baseURI).href;
}

function isSame(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((one) => b.includes(one));
}

/** Relative to the page, if it is below it and its name can be told so; see `io/address.ts`. */
function shortAddress(address: string): string {
  const folder = new URL('.', document.baseURI).href;
  const url = new URL(address);
  if (!address.startsWith(folder) || url.search !== '' || url.hash !== '') return address;
  try {
    const name = decodeURIComponent(address.slice(folder.length));
    return /[%:]/.test(name) ? address : name;
  } catch {
    return address;
  }
}
