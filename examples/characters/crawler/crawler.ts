/** The crawler example. */

import type { Sample } from '../example.ts';
import { pathSeconds } from '../motion/path.ts';
import { gaitChannels } from '../motion/walk.ts';
import { painted } from '../paint/atlas.ts';
import { bindingMatrices, posedFrames } from '../shape/skeletons.ts';
import { buildCrawlerMesh, paintCrawler } from './body.ts';
import { CRAWL_PATH, cornersOf, crawlPose } from './gait.ts';
import { CRAWLER_SKELETON, LEGS } from './skeleton.ts';

export function crawlerSample(): Sample {
  return {
    id: 'crawler',
    label: 'Crawler',
    description: 'A six-legged beetle with a tripod gait: three feet stay down while three step.',
    skeleton: CRAWLER_SKELETON,
    skin: buildCrawlerMesh().skin('crawler', bindingMatrices(posedFrames(CRAWLER_SKELETON)), {
      name: 'crawler',
      texture: 'crawler.png',
    }),
    morphs: [],
    take: {
      name: 'crawler_walk',
      range: [0, pathSeconds(CRAWL_PATH)],
      channels: gaitChannels({
        skeleton: CRAWLER_SKELETON,
        path: CRAWL_PATH,
        poseAt: crawlPose,
        frame: 0.012,
        care: (joint) => {
          const leg = LEGS.find((l) => joint.endsWith(`_${l.name}`));
          if (leg) return { tolerance: 0.005, corners: [...cornersOf(leg), ...cornersOf(leg).map((x) => x + 1)] };
          // The body carries the legs, so it needs a closer fit.
          return { tolerance: joint === 'body' ? 0.003 : 0.015 };
        },
      }),
    },
    rig: {
      name: 'crawler',
      skeleton: 'crawler.skel',
      skin: 'crawler.skin',
      morphs: [],
      animation: 'crawler_walk.anim',
    },
    textures: [painted('crawler.png', paintCrawler)],
  };
}
