/**
 * A page that opens with a static post: it draws only on changes, while playback costs a second of CPU time per second,
 * and the first frames of a skinned character four more.
 */
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { packedExample } from '../../examples/characters/packed.ts';
import type { ExtraFiles } from './server.ts';

const POST = 'balljoint post { boxmin -0.1 0 -0.1 boxmax 0.1 1 0.1 }';
const LISTING = { id: 'post', label: 'Post', description: '', files: ['post.skel'] };

/** What is served in place of the opening example of a built page. @param folder of the page */
export async function stillPage(folder: string): Promise<ExtraFiles> {
  const packed = readdirSync(join(folder, 'assets')).find((name) => /^opening-.*\.json$/.test(name));
  return {
    'samples/samples.json': JSON.stringify([LISTING]),
    'samples/post.skel': POST,
    // Builds of before have none.
    ...(packed !== undefined && { [`assets/${packed}`]: await packedExample(LISTING, [POST]) }),
  };
}
