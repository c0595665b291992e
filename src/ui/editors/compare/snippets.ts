/** Lines for programs of one's own, that print what can be compared. */
export const SNIPPETS: readonly (readonly [language: string, code: string])[] = [
  [
    'C++',
    `std::ofstream out("mine.txt");
out << "time " << time << "\\n";
for (const Joint* joint : jointsDepthFirst)
  out << joint->name << ": " << glm::to_string(joint->world) << "\\n";`,
  ],
  [
    'Python',
    `with open("mine.txt", "w") as out:
    print("time", time, file=out)
    for joint in joints_depth_first:
        print(joint.name + ":", *joint.world.flatten(), file=out)`,
  ],
  [
    'JavaScript',
    `let text = \`time \${time}\\n\`;
for (const joint of jointsDepthFirst)
  text += \`\${joint.name}: \${[...joint.world].join(' ')}\\n\`;
console.log(text);`,
  ],
];
