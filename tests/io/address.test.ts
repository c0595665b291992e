import { createServer, type RequestListener } from 'node:http';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { filesInQuery } from '../../src/io/address.ts';
import { fetchFiles } from '../../src/io/fetch-files.ts';

describe('files named in the address', () => {
  it('files named in the address are separated by commas', () => {
    expect(filesInQuery('?files=a.skel,b/c.skin')).toEqual(['a.skel', 'b/c.skin']);
  });

  it('files named in the address are none without the key', () => {
    expect(filesInQuery('')).toEqual([]);
    expect(filesInQuery('?file=a&files=')).toEqual([]);
  });

  it('files named in the address keep a percent sign that encodes nothing', () => {
    expect(filesInQuery('?files=100%.skel')).toEqual(['100%.skel']);
  });

  it('files named in the address come out as they went in when encoded, whatever is in their names', () => {
    const name = fc.string({ unit: 'grapheme', minLength: 1 });
    fc.assert(
      fc.property(fc.array(name, { minLength: 1 }), (names) => {
        expect(filesInQuery(`?theme=dark&files=${names.map(encodeURIComponent).join(',')}`)).toEqual(names);
      }),
    );
  });
});

/** Fetches `a.skel` from a server that answers as given. */
async function fetched(answer: RequestListener, signal?: AbortSignal) {
  const server = createServer(answer);
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  const address = server.address();
  if (address === null || typeof address === 'string') throw new Error('The server has no port.');
  try {
    return await fetchFiles(['a.skel'], `http://127.0.0.1:${address.port}/`, signal);
  } finally {
    server.closeAllConnections();
    server.close();
  }
}

describe('files that are fetched', () => {
  it('a file is its bytes', async () => {
    const [file] = await fetched((_, response) => response.end('balljoint a { }'));
    expect(file.path).toBe('a.skel');
    expect(await file.blob.text()).toBe('balljoint a { }');
  });

  it('a redirect is refused: it leads to what the address doesn’t name', async () => {
    const asked: (string | undefined)[] = [];
    const answer: RequestListener = (request, response) => {
      asked.push(request.url);
      response.writeHead(302, { location: '/elsewhere.skel' }).end();
    };
    // Node tells the status of a redirect, which browsers keep to themselves.
    await expect(fetched(answer)).rejects.toThrow(
      /"a.skel" could not be fetched: the server (redirects it|answered 302)/,
    );
    expect(asked).toEqual(['/a.skel']);
  });

  it('a file that ends before its stated length is refused, with how much came', async () => {
    const answer: RequestListener = (_, response) => {
      response.writeHead(200, { 'content-length': '1000' });
      response.write('ball', () => response.destroy());
    };
    await expect(fetched(answer)).rejects.toThrow(/^"a.skel" could not be fetched: it ended after \d bytes, before/);
  });

  it('a file without an end is cancelled at once', async () => {
    const abort = new AbortController();
    const answer: RequestListener = (_, response) => {
      response.writeHead(200);
      response.write('ball', () => abort.abort(new Error('Open cancelled.')));
    };
    await expect(fetched(answer, abort.signal)).rejects.toThrow('Open cancelled.');
  });
});
