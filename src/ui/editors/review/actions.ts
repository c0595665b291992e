/** Actions on takes in review. Their keys are those of the panel *Review*. */
import { needs } from '../../state/actions/needs.ts';
import { openPanel } from '../../state/panels/panels.ts';
import type { Action, Uses, Workbench } from '../../state/workbench.ts';
import { chosenPaths, hasChosenTake, hasReview } from './meant-takes.ts';

const MENU = 'Play/Review';
const edits = () => import('./edits.ts');
const NO_REVIEW = 'No takes to review. Drop a folder or a zip with more than 20 takes.';
const needsTakes = needs(NO_REVIEW, hasReview);
const needsChosen = needs(
  (wb: Uses<'store' | 'timeline'>) => (hasReview(wb) ? 'Select a take in the Review tab first.' : NO_REVIEW),
  hasChosenTake,
);

export const REVIEW_ACTIONS: readonly Action[] = [
  {
    id: 'review.list',
    label: 'Review takes',
    group: 'Play',
    menu: MENU,
    section: 1,
    refuses: needsTakes,
    run(wb) {
      openPanel(wb, 'timeline', true);
      wb.timeline.change({ tab: 'review' });
    },
  },
  {
    id: 'review.next',
    label: 'Next take in review',
    group: 'Play',
    menu: MENU,
    section: 2,
    panel: 'review',
    shortcuts: ['J', 'PageDown'],
    repeats: true,
    refuses: needsTakes,
    run: async (wb) => (await edits()).stepReview(wb, 1),
  },
  {
    id: 'review.previous',
    label: 'Previous take in review',
    group: 'Play',
    menu: MENU,
    section: 2,
    panel: 'review',
    shortcuts: ['Shift+J', 'PageUp'],
    repeats: true,
    refuses: needsTakes,
    run: async (wb) => (await edits()).stepReview(wb, -1),
  },
  {
    id: 'review.good',
    label: 'Good',
    also: 'verdict',
    ...judging('G', async (wb) => (await edits()).toggleVerdict(wb, 'good')),
  },
  {
    id: 'review.bad',
    label: 'Bad',
    also: 'verdict',
    ...judging('B', async (wb) => (await edits()).toggleVerdict(wb, 'bad')),
  },
  ...[0, 1, 2, 3, 4, 5].map(
    (stars): Action => ({
      id: `review.stars${stars}`,
      label: stars === 0 ? 'No stars' : stars === 1 ? '1 star' : `${stars} stars`,
      unchanged: `The selected takes already have ${stars === 0 ? 'no' : stars} star${stars === 1 ? '' : 's'}.`,
      ...judging(String(stars), async (wb) => (await edits()).judge(wb, { stars })),
    }),
  ),
  {
    id: 'review.clear',
    label: 'Clear verdict, stars, tags and notes',
    unchanged: 'The selected takes have no verdict, stars, tags or notes.',
    ...judging(undefined, async (wb) => (await edits()).clearReview(wb)),
  },
  {
    id: 'review.open',
    label: 'Open selected takes',
    detail: 'As characters',
    group: 'Play',
    menu: MENU,
    section: 4,
    panel: 'review',
    shortcuts: ['Ctrl+Enter'],
    refuses: needsChosen,
    run: async (wb) => (await edits()).openTakes(wb, chosenPaths(wb)),
  },
  {
    id: 'review.openGood',
    label: 'Open good takes',
    detail: 'As characters',
    group: 'Play',
    menu: MENU,
    section: 4,
    refuses: needs('No take has the verdict good.', ({ store }: Uses<'store'>) =>
      (store.document.review ?? []).some(({ verdict }) => verdict === 'good'),
    ),
    async run(wb) {
      const { goodPaths, openTakes } = await edits();
      openTakes(wb, goodPaths(wb));
    },
  },
  {
    id: 'review.saveCsv',
    label: 'Save review as CSV',
    detail: 'A list for the command line: --only review.csv',
    group: 'Play',
    menu: MENU,
    alsoIn: { menu: 'Save', section: 4 },
    section: 5,
    refuses: needsTakes,
    run: async (wb) => (await edits()).saveList(wb, 'csv'),
  },
  {
    id: 'review.saveJson',
    label: 'Save review as JSON',
    group: 'Play',
    menu: MENU,
    section: 5,
    refuses: needsTakes,
    run: async (wb) => (await edits()).saveList(wb, 'json'),
  },
  {
    id: 'review.remove',
    label: 'Remove selected takes from review',
    group: 'Play',
    menu: MENU,
    section: 6,
    panel: 'review',
    shortcuts: ['Delete'],
    refuses: needsChosen,
    run: async (wb) => (await edits()).removeTakes(wb),
  },
];

function judging(key: string | undefined, run: (wb: Workbench) => Promise<void>): Omit<Action, 'id' | 'label'> {
  return {
    group: 'Play',
    menu: MENU,
    section: 3,
    panel: 'review',
    ...(key !== undefined && { shortcuts: [key] }),
    refuses: needsChosen,
    run,
  };
}
