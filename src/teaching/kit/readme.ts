/** `README.md` of the test kit. */
import type { SetAnswers } from './answers.ts';

/** A word of a program in the text, which tools would take for one of this file's. */
const IMPORT = 'import';

/** The text of the test kit's README, with an entry per set. */
export function readme(sets: readonly SetAnswers[]): string {
  const entries = sets.map(
    ({ name, about, files, tells }) =>
      `### ${name}\n\n${files.map((file) => `\`${file}\``).join(', ')}\n\n${about}\n\nTells apart: ${tells.map((code) => `\`${code}\``).join(', ')}.\n`,
  );
  return `# Test kit

Small files that a program with a known mistake gets wrong, and the right numbers. Many mistakes stay hidden in larger
files: most characters rotate each joint about one axis only, and most keys are evenly spaced.

- \`answers.json\` has the right numbers: world and local matrices of each joint, vertices, normals, values of channels.
- \`answers.txt\` has the same, one per line: \`set time kind index numbers…\`, with \`pose\` for the time of the file pose.

Matrices are 16 numbers, column-major: the last four are the position, x y z 1. A frame without a time is the pose in the
file, without the animation and with morphs at 0. Joints are in depth-first order. Compare with a tolerance of 0.0001, more
if you use floats.

Marrow warns about weights that do not sum to 1, a vertex without attachments, two keys at one time and a pose beyond
its limits. All of these are intentional here.

What the files rely on:

- A pose beyond a limit is clamped to it; the translation of the root is not.
- The first three channels move the root, the next ones rotate each joint, x y z, and the last ones are the morph weights, in the
  order of the morphs' names.
- All attachments of a vertex are used, with weights as given; a vertex without any stays where it is.
- A normal is Σ w·(W·B⁻¹)⁻ᵀ·n, normalised: bindings are scaled here, so W·B⁻¹ alone is wrong.
- The axis-angle form uses degrees; a joint's frame is its parent's tip frame, rotated; children attach at the tip.
- Captured angles are degrees, position channels replace OFFSET, rotations are multiplied in the order of the channels.

## How to use it

Print your numbers and let Marrow name the mistake: drop \`tree.skel\` and \`mine.txt\` on the page, or run

    marrow compare tree.skel mine.txt
    marrow compare reed.skel reed.skin reed_bulge.morph reed_twist.morph reed_move.anim mine.txt --time 0.35
    marrow compare curves.anim values.csv

Or check them in your own test. Each of these needs one function of yours and fails on wrong numbers, NaN included: NaN is
neither larger nor smaller than a tolerance, so the tests ask for \`error <= tolerance\`.

C++, with \`answers.txt\`:

\`\`\`cpp
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

const float* worldOf(int joint);  // yours: 16 numbers by columns, as glm::value_ptr gives them

int main() {
  std::ifstream in("answers.txt");
  std::string line, set, time, kind;
  int joint, compared = 0, wrong = 0;
  while (std::getline(in, line)) {
    std::istringstream row(line);
    if (!(row >> set >> time >> kind >> joint) || set != "tree" || kind != "world") continue;
    const float* mine = worldOf(joint);
    bool agrees = true;
    for (int i = 0; i < 16; i++) {
      double right;
      row >> right;
      if (!(std::abs(mine[i] - right) <= 1e-4)) agrees = false;
    }
    compared++;
    if (!agrees) std::cout << "joint " << joint << " is wrong\\n", wrong++;
  }
  std::cout << compared << " joints compared, " << wrong << " wrong\\n";
  return compared > 0 && wrong == 0 ? 0 : 1;
}
\`\`\`

Java, with \`answers.txt\` (\`assert\` does nothing without \`-ea\`):

\`\`\`java
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

class CheckTree {
  public static void main(String[] args) throws IOException {
    int compared = 0;
    for (String line : Files.readAllLines(Path.of("answers.txt"))) {
      String[] row = line.split(" ");
      if (!row[0].equals("tree") || !row[2].equals("world")) continue;
      int joint = Integer.parseInt(row[3]);
      double[] mine = Mine.worldOf(joint);  // yours: 16 numbers by columns
      for (int i = 0; i < 16; i++) {
        double right = Double.parseDouble(row[4 + i]);
        if (!(Math.abs(mine[i] - right) <= 1e-4)) {
          throw new AssertionError("joint " + joint + ", number " + i + ": " + mine[i] + ", expected " + right);
        }
      }
      compared++;
    }
    if (compared == 0) throw new AssertionError("answers.txt has no rows of tree");
    System.out.println(compared + " joints agree");
  }
}
\`\`\`

Python, with \`answers.json\`:

\`\`\`python
import json
from mine import world_of  # yours: for files, a time and a joint, 4 rows of 4 numbers

SETS = ["tree"]  # more as you get there: sway, reed, morphs, march, arm
with open("answers.json") as file:
    sets = [answers for answers in json.load(file)["sets"] if answers["name"] in SETS]
assert len(sets) == len(SETS)
for answers in sets:
    for frame in answers.get("frames", []):
        time = frame.get("time")  # None: the pose of the file
        for j, joint in enumerate(frame["joints"]):
            mine = world_of(answers["files"], time, j)
            for i, right in enumerate(joint["world"]):  # by columns
                error = abs(mine[i % 4][i // 4] - right)
                assert error <= 1e-4, (answers["name"], time, joint["name"], i, error)
    print(answers["name"], "agrees")
\`\`\`

JavaScript, with \`answers.json\`, in Node as a module (\`check.mjs\`):

\`\`\`js
${IMPORT} assert from 'node:assert/strict';
${IMPORT} { readFileSync } from 'node:fs';
${IMPORT} { worldOf } from './mine.mjs'; // yours: 16 numbers by columns, as matrixWorld.elements of three.js

const { sets } = JSON.parse(readFileSync('answers.json', 'utf8'));
const [frame] = sets.find(({ name }) => name === 'tree').frames;
frame.joints.forEach(({ name, world }, j) => {
  const mine = worldOf(j);
  world.forEach((right, i) => assert(Math.abs(mine[i] - right) <= 1e-4, \`\${name}, number \${i}: \${mine[i]}, expected \${right}\`));
});
console.log(frame.joints.length, 'joints agree');
\`\`\`

## The files

${entries.join('\n')}`;
}
