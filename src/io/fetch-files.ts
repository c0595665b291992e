/** Fetches files by their addresses; loaded on first use. */
import { UserError } from '../model/user-error.ts';
import { pathOf } from './address.ts';
import type { GivenFile } from './given.ts';

/** A file that could not be fetched; the message is a sentence. */
export class FetchError extends UserError {
  override readonly name = 'FetchError';
}

/**
 * Fetches files, relative to the page. Throws a `FetchError` that names the first that failed. Paths keep the last
 * folder, so that files of one folder belong together.
 * @param cache `no-cache` for files that may have changed since they were last fetched
 */
export function fetchFiles(
  addresses: readonly string[],
  base: string,
  signal?: AbortSignal,
  cache: RequestCache = 'default',
): Promise<readonly GivenFile[]> {
  return Promise.all(
    addresses.map(async (address) => {
      const url = resolve(address, base);
      // Where it leads to isn't what the address names.
      const response = await fetch(url, { redirect: 'manual', cache, ...(signal && { signal }) }).catch(
        (error: unknown) => {
          if (signal?.aborted) throw error;
          throw new FetchError(
            `"${address}" could not be fetched: the server can’t be reached, or does not allow it (CORS).`,
          );
        },
      );
      if (response.type === 'opaqueredirect') {
        throw new FetchError(
          `"${address}" could not be fetched: the server redirects it. Name the address it leads to.`,
        );
      }
      if (!response.ok)
        throw new FetchError(`"${address}" could not be fetched: the server answered ${response.status}.`);
      const version = response.headers.get('etag') ?? response.headers.get('last-modified') ?? undefined;
      return {
        path: pathOf(url),
        blob: await bodyOf(response, address, signal),
        address: url.href,
        ...(version !== undefined && { version }),
      };
    }),
  );
}

/** Reading files takes several times as much memory. */
const MAX_BYTES = 2 ** 31;

/** All of it, as far as it has an end. @throws FetchError */
async function bodyOf(response: Response, address: string, signal?: AbortSignal): Promise<Blob> {
  const reader = response.body?.getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let bytes = 0;
  try {
    for (let next = await reader?.read(); next && !next.done; next = await reader?.read()) {
      parts.push(next.value);
      bytes += next.value.byteLength;
      if (bytes > MAX_BYTES) break;
    }
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new FetchError(`"${address}" could not be fetched: it ended after ${bytes} bytes, before it was complete.`);
  }
  if (bytes <= MAX_BYTES) return new Blob(parts);
  void reader?.cancel();
  throw new FetchError(`"${address}" could not be fetched: it has more than ${MAX_BYTES} bytes, or no end.`);
}

function resolve(address: string, base: string): URL {
  let url: URL;
  try {
    // In a path, `#` and `?` are part of the name; in a complete address they are not.
    url = /^[a-z][a-z0-9+.-]*:/i.test(address)
      ? new URL(address)
      : new URL(encodeURI(address).replaceAll('#', '%23').replaceAll('?', '%3F'), base);
  } catch {
    throw new FetchError(`"${address}" is not a file address.`);
  }
  if (url.protocol === 'http:' || url.protocol === 'https:') return url;
  throw new FetchError(`"${address}" can't be fetched: only http and https can.`);
}
