/** The examples that come with the page: their list, and the files of one. */
import { address } from 'virtual:opening-sample';
import { pathOf } from '../io/address.ts';
import type { DiskFile } from '../io/disk-files.ts';
import { unpackFiles } from '../io/packed-files.ts';
import type { ParsedFile } from '../model/files.ts';
import type { GivenBlob } from '../worker/protocol.ts';
import type { SampleSwitches } from './example-display.ts';

export interface BundledExample {
  readonly id: string;
  readonly label: string;
  readonly description: string;
  /** Names next to `samples.json`. */
  readonly files: readonly string[];
  readonly shows?: SampleSwitches;
}

/** An example that was read when the page was built. */
export interface PackedExample {
  readonly shows?: SampleSwitches;
  /** For `unpackFiles`. */
  readonly files: unknown;
}

const FOLDER = 'samples/';

/** The examples, the opening one first. Empty if the page was published without them. */
export async function listSamples(page: string): Promise<readonly BundledExample[]> {
  const response = await fetch(new URL(`${FOLDER}samples.json`, page)).catch(() => undefined);
  if (!response?.ok) return [];
  // Generated at build time and checked by tests.
  return (await response.json()) as BundledExample[];
}

/** An example without its texts, which are read from their addresses once they are shown. */
export interface ReadExample {
  readonly shows: SampleSwitches | undefined;
  readonly files: readonly ParsedFile[];
  readonly texts: readonly DiskFile[];
}

/** Fetches the opening example, which was read when the page was built; undefined in development, or if it isn't there. */
export async function fetchOpening(page: string, signal: AbortSignal): Promise<ReadExample | undefined> {
  if (address === undefined) return undefined;
  const response = await fetch(address, { signal }).catch(() => undefined);
  if (!response?.ok) return undefined;
  // Made by the same build.
  const { shows, files } = (await response.json()) as PackedExample;
  const placed = unpackFiles(files).map((file) => {
    const url = new URL(`${FOLDER}${file.source.name}`, page);
    const source = { ...file.source, path: pathOf(url) };
    return { file: { ...file, source }, text: { path: source.path, address: url.href } };
  });
  return { shows, files: placed.map(({ file }) => file), texts: placed.map(({ text }) => text) };
}

export async function fetchSample(
  sample: BundledExample,
  page: string,
  signal?: AbortSignal,
): Promise<readonly GivenBlob[]> {
  const { fetchFiles } = await import('../io/fetch-files.ts');
  const addresses = sample.files.map((name) => `${FOLDER}${name}`);
  return fetchFiles(addresses, page, signal);
}
