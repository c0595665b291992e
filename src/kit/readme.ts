/** `README.md` of the test kit. */
import type { SetAnswers } from './answers.ts';

export function readme(sets: readonly SetAnswers[]): string {
  const entries = sets.map(
    ({ name, about, files, tells }) =>
      `### ${name}\n\n${files.map((file) => `\`${file}\``).join(', ')}\n\n${about}\n\nTells apart: ${tells.map((code) => `\`${code}\``).join(', ')}.\n`,
  );
  return `# Test kit

Small files that a program with a known mistake gets wrong, and the right numbers. Many mistakes do not show in larger
files: most characters turn each joint about one axis, and most keys are evenly spaced.

- \`answers.json\` has the right numbers: world and local matrices of each joint, vertices, normals, values of channels.
- \`answers.txt\` has the same, a line each: \`set time kind index numbers…\`, with \`pose\` for the time of the file pose.

Matrices are 16 numbers by columns: the last four are x y z 1 of the position. A frame without a time is the pose of the
file, without the animation and with morphs at 0. Joints are in depth-first order. Compare with a tolerance of 0.0001, more
if you use floats.

Marrow warns about weights that do not add up to 1, a vertex without attachments, two keys at one time and a pose beyond
its limits: all are meant here.

What the files rely on:

- A pose beyond a limit is clamped to it; the translation of the root is not.
- The first three channels move the root, the next ones are x y z of each joint, the last ones weights of morphs in the
  order of their names.
- All attachments of a vertex are used, with weights as given; a vertex without any stays where it is.
- A normal is Σ w·(W·B⁻¹)⁻ᵀ·n, normalised: bindings are scaled here, so W·B⁻¹ itself will not do.
- The axis-angle form has degrees; a joint's frame is its parent's tip, turned; children are attached at the tip.
- Captured angles are degrees, position channels replace OFFSET, rotations are multiplied in the order of the channels.

## How to use it

Print your numbers, and let Marrow name the mistake: drop \`tree.skel\` and \`mine.txt\` on the page, or run

    marrow compare tree.skel mine.txt
    marrow compare reed.skel reed.skin reed_bulge.morph reed_twist.morph reed_move.anim mine.txt --time 0.35
    marrow compare curves.anim values.csv

Or check them in a test of your own.

C++, with \`answers.txt\`:

\`\`\`cpp
std::ifstream in("answers.txt");
std::string line, set, time, kind;
while (std::getline(in, line)) {
  std::istringstream row(line);
  int index;
  if (line[0] == '#' || !(row >> set >> time >> kind >> index)) continue;
  if (set != "tree" || kind != "world") continue;
  double right[16];
  for (double& x : right) row >> x;
  const glm::mat4 mine = skeleton.joints[index]->world;  // by columns, as here
  for (int i = 0; i < 16; i++) assert(std::abs(mine[i / 4][i % 4] - right[i]) < 1e-4);
}
\`\`\`

Java, with \`answers.txt\`:

\`\`\`java
for (String line : Files.readAllLines(Path.of("answers.txt"))) {
  String[] row = line.split(" ");
  if (!row[0].equals("tree") || !row[2].equals("world")) continue;
  double[] mine = skeleton.joint(Integer.parseInt(row[3])).worldByColumns();
  for (int i = 0; i < 16; i++) assert Math.abs(mine[i] - Double.parseDouble(row[4 + i])) < 1e-4;
}
\`\`\`

Python:

\`\`\`python
import json, numpy as np
for answers in json.load(open("answers.json"))["sets"]:
    for frame in answers.get("frames", []):
        for joint, right in zip(my_joints(answers["files"], frame.get("time")), frame["joints"]):
            np.testing.assert_allclose(joint, np.reshape(right["world"], (4, 4)).T, atol=1e-4)
\`\`\`

JavaScript, with three.js:

\`\`\`js
const { sets } = JSON.parse(await readFile('answers.json', 'utf8'));
const [frame] = sets.find(({ name }) => name === 'tree').frames;
frame.joints.forEach(({ name, world }, j) => {
  myJoints[j].matrixWorld.elements.forEach((x, i) => assert(Math.abs(x - world[i]) < 1e-4, name));
});
\`\`\`

## The files

${entries.join('\n')}`;
}
