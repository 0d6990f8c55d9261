// Everything that the page says, in English: every sentence of it stands here, and this is the one file to translate. Numbers
// come in written out, or are written here with their unit. What the robot says of itself comes from its nodes.

export const LANGUAGE = "en";

const cm1 = (m) => (100 * m).toFixed(1);
/** With a capital letter. */
export const sentence = (words) => (words ? words[0].toUpperCase() + words.slice(1) : "");

// ---- the bar at the top -------------------------------------------------------------------------------------------

/** What stands in index.html: an element's `data-words` names its text, `data-words-label` and the like its attributes. */
export const BAR = {
  name: "apprentice",
  title: "apprentice: teach the table",
  tab: (what) => `${what} · apprentice`,
  question: "A question",
  skip: "Go to the object to place",
  skipToAnswer: "Go to your answer",
  skipToCaution: "Go to how cautious the robot is",
  revision: "revision",
  rev: "rev",
  theme: "Switch between light and dark",
  dismiss: "Dismiss",
};

/** How the lesson stands, in a word or two. */
export const STATES = { waiting: "Waiting for the lesson", asking: "Learning", taught: "Taught", stopped: "Stopped", gave_up: "Gave up", paused: "Paused", finished: "Finished", misfit: "Does not fit" };

/** The connection and the nodes. */
export const LINK = {
  connecting: "Connecting…",
  lost: "Reconnecting…",
  expired: "Open the new address",
  open: "Connected",
  old: "This page's address is no longer valid: open the one that the operator page printed when it started.",
  title: "Nodes",
  page: "this page",
  states: { alive: "alive", late: "late", gone: "gone" },
  node: (name, state) => `${name} ${LINK.states[state] ?? state}`,
  state: (state, restarts) => `${LINK.states[state] ?? state}${restarts ? `, restarted ${restarts}×` : ""}`,
  hint: "Late: silent for 2 s. Gone: silent for 5 s.",
  silent: "No heartbeat has been heard yet.",
};

// ---- the lesson as a whole ----------------------------------------------------------------------------------------

export const SESSION = {
  menu: "Lesson",
  pause: "Pause",
  finish: "Finish",
  begin: "New lesson…",
  report: "Report…",
  load: "Take up a recording…",
  go: (word, isFresh) => (word === "paused" ? (isFresh ? "Start the lesson" : "Go on") : word === "finished" ? "Go on teaching" : word === "stopped" ? "Take the stop back" : SESSION.pause),
  halted: (word, isFresh) => ({
    paused: isFresh ? "The lesson has not been started yet." : "The lesson is paused. The robot asks nothing; you may still correct it.",
    finished: "You finished the lesson. The robot keeps what it learned.",
    stopped: "You stopped the lesson because nothing was acceptable.",
  })[word],
  recording: ({ began_s, duration_s, bytes }) => [began_s === null ? null : new Date(1000 * began_s).toLocaleString(), `${Math.round(duration_s / 60)} min`, `${(bytes / 1e6).toFixed(1)} MB`].filter(Boolean).join(" · "),
};

export const DIALOG = {
  stopTitle: "Stop the lesson?",
  stopWhy: "Use this when nothing the robot could do here is acceptable. It will ask no further questions. You can still take this answer back.",
  stopReason: "What is wrong? (may stay empty)",
  keepTeaching: "Keep teaching",
  stop: "Stop the lesson",
  newTitle: "Begin a new lesson?",
  newWhy: "The robot forgets what it was taught, and asks from the beginning. What was said stays recorded, and you can take this step back.",
  keepLesson: "Keep this lesson",
  begin: "New lesson",
  loadTitle: "Take up a recording",
  loadWhy: "A new lesson begins with everything that counted in the recording. You can take this step back.",
  noRecordings: "There is no recording beside this session.",
  load: "Take it up",
  report: "Lesson report",
  print: "Print…",
  close: "Close",
};

// ---- what both kinds of lesson say --------------------------------------------------------------------------------

export const QUESTION = {
  question: "Question",
  number: (n) => `Question ${n || ""}`,
  lesson: "The lesson",
  correction: "Your correction",
  moment: "One moment…",
  waiting: "The page is waiting for the robot's first question.",
  where: (name) => `Where does the ${name} belong?`,
  correct: (name) => `Show where the ${name} belongs on the table as it is.`,
  it: "it",
  titles: { taught: "The robot has learned enough.", stopped: "The lesson is stopped.", gave_up: "The robot gave up asking.", paused: "The lesson is paused.", finished: "The lesson is finished.", misfit: "What was said does not fit together." },
  thinking: "Thinking about the next question…",
};

/** How far the robot may be off, against the goal. */
export const GAUGE = {
  worst: "at worst",
  here: "here",
  goal: "goal",
  none: "no bound yet",
  label: (bound, goal) => `At worst ${bound} off, goal ${goal}`,
  mayLose: "may lose",
  lossLabel: (bound, goal) => `Of what choosing at random loses, the robot may lose ${bound ?? "an unknown share"}; the goal is ${goal}`,
};

/** The buttons under every answer, and what became of what was pressed. */
export const ANSWER = {
  label: "Your answer",
  howSure: "How sure are you?",
  sure: "Sure",
  fairly: "Fairly sure",
  guess: "A guess",
  enter: "Enter",
  skip: "Skip",
  skipTitle: "Ask me something else; this counts for nothing",
  cantTell: "Can't tell",
  cantTellTable: "I have no opinion about this table",
  cantTellWorld: "I have no opinion about this",
  undo: "Undo",
  undoTitle: "Take the last answer back",
  redo: "Redo",
  redoTitle: "Give the last answer taken back once more",
  stop: "Stop…",
  stopTitle: "None of this is acceptable: stop the lesson",
  sending: "Sending…",
  onItsWay: "On its way to the robot…",
  takenIn: (revision) => `Taken in as revision ${revision}`,
  refused: (reason) => `Refused: ${reason}`,
  takingBack: "Taking it back…",
  takenBack: (revision) => `Taken back in revision ${revision}`,
  notTakenBack: (reason) => `Could not be taken back: ${reason}`,
};

/** The list of what was said. */
export const ANSWERS = {
  title: "Answers",
  none: "Nothing has been answered yet.",
  count: (active, all) => `${active} in force of ${all}`,
  you: "you",
  confidence: { sure: "sure", fairly: "fairly sure", guess: "a guess" },
  kinds: { skip: "Skipped", cant_tell: "Can't tell", stop: "Stopped the lesson", pause: "Paused", start: "Started", finish: "Finished the lesson", new_lesson: "Began a new lesson" },
  counted: { actions: (n) => `Showed a walk of ${n} steps`, preference: (n) => `Compared ${n} walks`, critique: (n) => `Marked ${n} parts of a walk`, history: (n) => `${n} attempts of a learner` },
  placement: (label, x_m, y_m) => `${label ?? "Target"} at ${cm1(x_m)} × ${cm1(y_m)} cm`,
  takeBack: "Take back",
  giveAgain: "Give again",
  button: (does, what) => `${does}: ${what}`,
  earlier: (fate) => `An earlier answer: ${fate}`,
  misfit: "fits worst with the rest", pending: "on its way…",
  held: "waits for the new lesson…",
  revision: (n) => `revision ${n}`,
  past: (n) => `revision ${n}, of an earlier lesson`,
  refused: (reason) => `refused: ${reason}`,
  undone: (n) => (n === null ? "taken back" : `taken back in revision ${n}`),
  notUndone: (n, reason) => `revision ${n}; could not be taken back: ${reason}`,
  undoing: "being taken back…",
};

/** How the bound fell. */
export const PROGRESS = {
  left: (answered, most) => (answered === null ? "" : most === null ? `${answered} given so far.` : most > 200 ? `${answered} given so far; it may take very many more.` : `${answered} given so far; at this pace about ${most <= 1 ? "one more" : `${Math.max(1, Math.round(most / 2))} to ${Math.round(most * 1.5)} more`}.`),
  title: "How sure the robot is",
  log: "log",
  label: "Bound against the goal, per revision",
  lossUnit: "loss, % of choosing at random",
  lossLabel: "Bound on the loss, per revision",
  receipt: "Everything this claim rests on",
  goal: "goal",
  noBound: (revision, reason) => `revision ${revision}: no bound. ${reason}`,
  bound: (revision, bound) => `revision ${revision}: ${bound}`,
  course: (goal, looks) => `Bound against the goal of ${goal}: ${looks.map(([revision, bound]) => `revision ${revision} ${bound ?? "no bound"}`).join(", ")}`,
  none: "No bound yet",
};

/** The lines of a receipt, by field. */
export const RECEIPT = {
  names: {
    claim: "Claim", bound_m: "Bound", alpha: "α, share of rewards covered", delta: "δ, chance that the bound is wrong", look: "Looks at the bound so far", delta_spent: "δ spent on each table of this look",
    n: "Draws", ess_min: "Effective draws, least", rhat_max: "R̂, worst", acceptance: "Acceptance", beta: "β, rationality assumed", prior: "Prior", evidence_hash: "Evidence, SHA-256", seed: "Seed", version: "Version",
    reason: "Claim", least: "Least return", mean: "The same for the best on average", loss_bound: "Largest loss", share: "Of what choosing at random loses",
    chosen_by: "Draws that chose the policy", held_out: "Worst case on these others", gap: "Another policy may be better by",
  },
  none: "none",
  draws: (n, chains) => `${n} in ${chains} chains`,
  chosenBy: (n) => `${n}; others judge it`,
  heldOut: (worst, sure, [low, high]) => `${worst}, ${sure} sure between ${low} and ${high}`,
};

// ---- a lesson about a table ---------------------------------------------------------------------------------------

export const TABLE = {
  label: "The table from above",
  waiting: "Waiting for a table",
  side: "robot's side",
  tray: ["drag it", "onto the", "table"],
  trayInOne: "drag it onto the table",
  shape: (object, size) => (object.shape === "box" ? `box ${size[0]} × ${size[1]} cm` : `round ${size[0]} cm`),
  object: (object, shape) => `${object.label}: ${shape}${object.supports ? ", things may stand on it" : ""}`,
  waits: (label, shape) => `${label}, ${shape}, beside the table. Arrow keys put it on the table and move it by 5 millimetres, with Shift by 2 centimetres; Enter answers.`,
  stands: (label, shape, at, blocked) => `${label}, ${shape}, ${cm1(at.x)} centimetres from the left and ${cm1(at.y)} from the robot's edge${blocked ? `; not possible: ${blocked}` : ""}`,
  overEdge: "it would stick out over the table's edge",
  touches: (label) => `it would touch the ${label}`,
  guess: "robot's guess",
  cautious: "cautious guess",
  place: "the robot's place",
  mark: (revision) => `revision ${revision ?? "…"}`,
  solid: "Arm in 3-D",
  heat: "Reward map",
  key: "Brown hatching: occupied. Grey hatching: out of the arm's reach.",
  readout: (at, blocked, far) => `${cm1(at.x)} cm from the left, ${cm1(at.y)} cm from the robot's edge${blocked ? ` · ${blocked}` : far ? " · out of the arm's reach" : ""}`,
  whichPlace: "Which of the two places is better?", sayEqual: "About equal", choose: "That is my choice", neither: "Neither: I show where", backToPair: "Back to A and B", todoPair: "Choose A or B, here or on the table.",
  better: (letter) => `${letter} is better`, at: ({ x_m, y_m }) => `${cm1(x_m)} cm from the left, ${cm1(y_m)} cm from the robot's edge`, option: (letter, name) => `Place ${letter} for the ${name}`, compared: { ranked: "Chose the better of two places", equal: "Two places are about equal", cant_tell: "Can't tell which of two places is better" },
  placeIt: "Place it here",
  submit: (name) => `Place the ${name} here`,
  another: "Show another placement",
  notThere: (blocked) => `Not there: ${blocked}.`,
  far: "The arm does not reach this spot, but you may say so.",
  drag: "Drag it there, or use the arrow keys.",
  keys: "Arrow keys: 5 mm, with Shift 2 cm.",
  hidden: (name) => `The robot's guess stays hidden until you place the ${name}.`,
  apart: (distance) => `The robot guessed ${distance} from yours.`,
  noGuess: (reason) => `The robot has no guess: ${reason}`,
  notArrived: "The robot's guess has not arrived.",
  wouldPut: (name, at, motion_s) => `On this table the robot would put the ${name} ${cm1(at.x_m)} cm from the left, ${cm1(at.y_m)} cm from its edge${motion_s === null ? "" : `, in a motion of ${motion_s.toFixed(1)} s`}.`,
};

/** How the robot would carry out its plan. */
export const CARRY = {
  label: "The arm at the table",
  home: "Reset view",
  moment: "Moment of the motion",
  play: "Play the motion",
  pause: "Pause",
  noPicture: "This browser cannot draw in three dimensions.",
  time: (seconds, last) => (seconds === null ? `The arm as it is; the motion takes ${last.toFixed(1)} s` : `${seconds.toFixed(1)} of ${last.toFixed(1)} s`),
  picture: (scene, plan) => `The arm at the table with ${scene.objects.map((object) => object.label).join(", ") || "nothing on it"}.${plan ? ` ${plan.reason}` : ""} Arrow keys turn the picture, plus and minus bring it nearer.`,
  hint: "Drag to turn the picture; with the focus on it, scroll or pinch to come nearer.",
  doing: ({ stage, over, done, reason, progress }) => over ? (done ? "It stands in its place." : `The robot did not put it there: ${reason}.`)
    : `${{ approaching: "The empty hand goes to it", grasping: "The gripper closes", moving: "The arm takes it there", releasing: "The gripper lets go", retreating: "The empty hand goes away" }[stage]} (${Math.round(100 * progress)} %).`,
  considered: (n) => (n === 1 ? "The one place it considered" : `${n} places it considered`),
  verdict: ({ x_m, y_m, verdict, reason }) => `${cm1(x_m)} × ${cm1(y_m)} cm: ${{ chosen: "chosen", next_best: "would do too" }[verdict] ?? reason}`,
  numbers: ({ probability_best, cvar_m, clearance_m }) => [
    probability_best === null ? null : `best for ${Math.round(100 * probability_best)} % of the rewards that fit`,
    cvar_m === null ? null : `in the worst cases ${cm1(cvar_m)} cm off`,
    clearance_m === null ? null : `${cm1(clearance_m)} cm free around it`,
  ].filter(Boolean).join(" · "),
};

// ---- a lesson about a world ---------------------------------------------------------------------------------------

/** Names of the lanes from the left, the roadside outermost. */
export function laneNames(lanes) {
  const road = lanes - 2, named = { 1: ["the lane"], 2: ["left lane", "right lane"], 3: ["left lane", "centre lane", "right lane"] }[road];
  return ["left roadside", ...(named ?? Array.from({ length: road }, (_, i) => `lane ${i + 1}`)), "right roadside"];
}

function cellPlace(world, s) {
  const { columns } = world.picture, feature = world.cells[s];
  return `row ${Math.floor(s / columns) + 1}, column ${(s % columns) + 1}${feature === null ? "" : `, ${world.features[feature]}`}`;
}

function roadPlace(world, s) {
  const { lanes, places } = world.picture, names = laneNames(lanes);
  const place = s % places, traffic = Math.floor(s / places) % (lanes - 2), lane = Math.floor(s / (places * (lanes - 2)));
  const where = place === 0 ? "far ahead" : place === places - 1 ? "behind" : `${place} of ${places - 1} closer`;
  return `in the ${names[lane]}, traffic ${where} in the ${names[traffic + 1]}`;
}

/** Which state, in words. */
export function placeWords(world, s) {
  if (world.picture.kind === "cells") return cellPlace(world, s);
  return world.picture.kind === "road" ? roadPlace(world, s) : `state ${s}`;
}

/** "right, right, up" with what lies on the way: "path 3 times, mud once". */
export function wayWords(world, way) {
  const counts = new Map();
  for (const s of way.states) { const f = world.cells[s] ?? null; if (f !== null) counts.set(f, (counts.get(f) ?? 0) + 1); }
  const over = [...counts].sort((a, b) => b[1] - a[1]).map(([f, n]) => `${world.features[f]}${n > 1 ? ` ×${n}` : ""}`);
  return { moves: way.actions.filter((_, i) => !world.terminals.includes(way.states[i])).map((a) => world.actions[a]).join(", "), over: over.join(", ") };
}

export const WORLD = {
  stage: "The world and what the robot would do in it",
  label: "The world",
  titles: { asking: "The robot is learning what you want.", taught: "The robot has learned enough.", stopped: "The lesson is stopped.", gave_up: "The robot gave up learning.", paused: "The lesson is paused.", finished: "The lesson is finished.", misfit: "What was said does not fit together." },
  thinking: "Thinking about what to do…",
  undecided: "The robot has not decided what to do.",
  show: "What I would do",
  collision: "collision",
  roadside: "roadside",
  noPicture: (states, actions) => `${states} states of ${actions} actions: too many to draw, or in no order that can be drawn.`,
  preview: "A preview: the robot does not do this yet.",
  gridKey: "Arrows: what the robot does; thick where it often comes. Dashed rings: where it starts.",
  roadKey: "Column: the robot's lane. Row: how near the traffic is, far ahead at the top. Shaded: where the robot comes.",
  noPolicy: "There is no policy yet.",
  grid: (rows, columns, way) => `A grid of ${rows} rows and ${columns} columns. ${way}`,
  from: (row, column, moves) => `From row ${row}, column ${column}: ${moves.join(", ")}.`,
  road: (lanes, starts) => `A road of ${lanes} lanes with the roadside left and right. Each panel is for traffic in one lane. ${starts ? `At the start: ${starts.join("; ")}.` : WORLD.noPolicy}`,
  traffic: (lane) => `traffic in the ${lane}`,
  place: (world, s) => `${sentence(placeWords(world, s))}.`,
  state: (world, s, does) => `${sentence(placeWords(world, s))}: ${does ?? "no policy yet"}`,
  ends: "it ends here",
  told: "What it was told",
  none: "Nothing has been shown yet.",
  claimWaits: "Its bound is being worked out",
  claim: (sure, least, share) => `${sure} sure: at least ${least} in ${share} of what you may mean`,
};

/** What the robot takes the person to want. */
export const WEIGHTS = {
  title: "What it takes you to want",
  picture: "What each feature may be worth",
  row: (name, mean, low, high) => `${name}: ${mean}, nine in ten between ${low} and ${high}`,
  label: (rows) => `Worth of each feature: ${rows.map(([name, mean, low, high]) => `${name} ${mean}, between ${low} and ${high}`).join("; ")}`,
  none: "Nothing is known of the features yet",
};

/** What caution costs, and how cautious the robot is to be. */
export const CAUTION = {
  title: "How cautious should it be?",
  picture: "Average return against the worst case",
  slider: "Weight of the average against the worst case",
  worst: "worst case",
  average: "average",
  apply: "Follow this balance",
  preview: "a preview",
  chosen: "as you chose",
  set: "as it was set",
  waits: "The robot is working it out.",
  flat: "Here caution costs nothing: every balance comes to the same.",
  point: (average, worst, change) => `Average ${average}, worst case ${worst}.${change}`,
  better: (by) => `${by} better`,
  worse: (by) => `${by} worse`,
  change: (average, worst) => { const parts = [average && `on average ${average}`, worst && `in the worst case ${worst}`].filter(Boolean); return parts.length ? ` Against now: ${parts.join(", ")}.` : " The same as now."; },
  value: (average, worst) => `average return ${average}; ${worst}`,
  share: (share) => `${share} average`,
  noFrontier: "There is no frontier yet",
  frontierNone: "no frontier yet",
  frontierWaits: "waiting for the frontier",
  tail: (share) => (share === null ? "the worst case" : `the worst ${share}`),
  worstAxis: (objective, tail) => `${{ evd: `average in ${tail} (0: nothing lost)`, regret: `average in ${tail}, above what was shown` }[objective] ?? `average return in ${tail}`} →`,
  averageAxis: "average return →",
  balance: (lambda, average, worst) => `balance ${lambda}: average ${average}, worst case ${worst}`,
  frontier: (average, worst) => `From the worst case to the average: average return ${average.join(" to ")}, worst case ${worst.join(" to ")}`,
};

/** The risk of a policy by what it is measured against; `by` is how much, without a sign. */
export const RISK = {
  worst: {
    evd: (share, by) => `In the worst ${share} of what the person may mean, it loses ${by} on average against the best that can be done.`,
    above: (share, by) => `In the worst ${share} of what the person may mean, it returns ${by} more on average than what was shown.`,
    below: (share, by) => `In the worst ${share} of what the person may mean, it falls ${by} short of what was shown on average.`,
    robust: (share, value) => `In the worst ${share} of what the person may mean, the return is ${value} on average.`,
  },
  rule: {
    evd: (share, by) => `In the other ${share} it loses at most ${by}.`,
    above: (share, by) => `In the other ${share} it returns at least ${by} more.`,
    below: (share, by) => `In the other ${share} it falls at most ${by} short.`,
    robust: (share, value) => `In the other ${share} it is at least ${value}.`,
  },
};

// ---- questions about a world --------------------------------------------------------------------------------------

export const LETTERS = ["A", "B"];
export const MARKS = { good: "good", bad: "bad", none: "not marked" };
export const WORDS = {
  lesson: "What the robot would do",
  whatHere: "What should the robot do here?",
  whichBetter: "Which of the two ways is better?",
  whichSteps: "Which steps are good, and which are bad?",
  playBoth: "Play both",
  stepOfBoth: "Step of both ways",
  keys: "Press a step again to change it; keys: G good, B bad, U neither.",
  allGood: "All good",
  clear: "Clear",
  submitAction: "Do this here",
  submit: { action: "Do this here", critique: "That is my judgement", comparison: "That is my choice" },
  todo: { action: "Choose what to do there, with a button or the arrow keys.", critique: "Mark at least one step; what you leave unmarked says nothing.", comparison: "Watch both, then choose." },
  sayEqual: "About equal",
  way: (i) => `${LETTERS[i]} is better`,
  step: (world, way, i, mark) => `Step ${i + 1} of ${way.states.length}, ${world.actions[way.actions[i]]}, ${placeWords(world, way.states[i])}: ${MARKS[mark]}`,
  time: (world, ways, t) => ways.map((way, i) => { const at = Math.min(t, way.states.length - 1); return `${LETTERS[i]}: ${placeWords(world, way.states[at])}`; }).join("; "),
  play: (playing) => (playing ? "Pause" : WORDS.playBoth),
  picture: {
    action: (world, q) => `The robot is ${placeWords(world, q.state)}.`,
    critique: (world, q) => `The way in question: ${q.ways[0].states.map((s, i) => `${i + 1}: ${placeWords(world, s)}, ${world.actions[q.ways[0].actions[i]]}`).join("; ")}.`,
    comparison: (world, q) => q.ways.map((way, i) => `Way ${LETTERS[i]}: ${wayWords(world, way).moves}, over ${wayWords(world, way).over || "nothing named"}.`).join(" "),
  },
  hidden: "What I would do is hidden until you have answered.",
  answer: (world, answer) => {
    if (answer.kind === "actions" && answer.step && answer.step[1] < world.actions.length && answer.step[0] < world.n_states) return `${world.actions[answer.step[1]]} in ${placeWords(world, answer.step[0]).replace(/^in /, "")}`;
    if (answer.kind === "preference" && answer.said) return { ranked: "Chose the better of two ways", equal: "Two ways are about equal", cant_tell: "Can't tell which of two ways is better" }[answer.said];
    if (answer.kind === "critique" && answer.marked) return `Marked ${answer.marked[0]} good and ${answer.marked[1]} bad steps`;
    return undefined;
  },
};

// ---- the report of a lesson ---------------------------------------------------------------------------------------

/** Says "the person", not "you": whoever reads it need not be the one who taught. What is here without a full stop gets one, and a capital. */
export const REPORT = {
  title: DIALOG.report,
  none: {
    subject: "Nothing is known yet of what is taught.", look: "No bound has been looked at in this lesson.", answers: "Nothing has been answered.", plan: "The robot has no plan for the table as it is.",
    bound: "no bound", claim: "There is no bound, so there is no claim.", judgement: "The bound on the robot's policy is not there yet.",
  },
  /** What must not be torn apart at the end of a line. */
  unbroken: (words) => words.replace(/(\d) (?=%|cm\b)|(revision) (?=\d)/g, "$1$2\u00a0"),
  place: (left, edge) => `${left} from the left, ${edge} from the robot's edge`,
  where: (name) => `Where the ${name ?? "target"} belongs`,
  world: (name) => `What to do in the world “${name}”`,
  lesson: {
    waiting: "No lesson has begun", asking: "Still learning", taught: "Taught: the robot has learned enough", stopped: "Stopped by the person", gave_up: "The robot gave up asking",
    paused: "Paused: the robot asks nothing for now", finished: "Finished: the person said that this is enough", misfit: "What was said does not fit together", unknown: "Where the lesson stands is not known",
  },
  because: (state, reason) => `${state}; ${reason}`,
  facts: { worst: "At worst", goal: "Goal", inForce: "Answers in force", revision: "Revision", atRandom: "Asked at random" }, atRandom: (n, odd) => `${n}, ${odd} not as expected`,
  aim: (goal, isReached) => (goal === null ? "No goal is known" : `The goal is ${goal}${isReached === null ? "" : isReached ? ": reached" : ": not reached"}`),
  nothing: (reason) => `Nothing guarantees how well the robot does: ${reason || "no bound has been computed"}`,
  loses: (share) => `the robot loses at worst ${share} of what choosing at random loses`,
  puts: (name, distance) => `the robot puts the ${name ?? "target"} at worst ${distance} from where the person would`,
  guarantee: (sure, what, share) => `${sure === null ? "By a bound whose receipt is not at hand" : `With ${sure} confidence`}, ${what}${share === null ? "" : `, for ${share} of what the person may mean`}`,
  claim: (sentence) => `The claim in full: ${sentence}`,
  late: (bound, now) => `This bound is of revision ${bound}; what was said since, up to revision ${now}, is not in it.`,

  // How the bound fell.
  progress: "The bound against the goal",
  courseOfLoss: "What the robot may lose, in % of what choosing at random loses, after each revision; dashed: the goal",
  courseOfDistance: "How far off the robot may be at worst, in cm, after each revision; dashed: the goal",
  hollow: (none, all) => `Hollow marks at the top: there was no bound (${none} of ${all} looks)`,

  // What was said.
  answers: "What was said",
  count: (active, all) => `${active} of ${all} in force`,
  newest: (n) => `These are the newest ${n}; earlier ones are not shown.`,
  number: "No.",
  columns: { table: "Table", asked: "Asked", answered: "Answered", sure: "How sure", became: "What became of it", by: "By" },
  asked: { actions: "What to do", preference: "Which of two ways is better", critique: "What is good and what is bad in a way" },
  askedThere: (world, s) => `What to do ${placeWords(world, s).replace(/^(?!in )/, "in ")}`,
  unnamed: { question: BAR.question, nothing: "Nothing", place: "A place" },
  unasked: "(not asked)",
  kinds: { ...ANSWERS.kinds, pause: "Paused the lesson", start: "Started the lesson" },
  fate: (isInForce, fate) => (isInForce ? `in force, ${fate}` : fate),

  // What the robot makes of it.
  robot: "What the robot would do now",
  isOpen: "A question is open. What the robot would do is left out, so that it does not sway the answer.",
  oldPlan: (plan, now) => `This plan is of revision ${plan}; the answers are at revision ${now}.`,
  oldPolicy: (policy, now) => `This policy is of revision ${policy}; the answers are at revision ${now}.`,
  otherTable: "This plan is for a table that has changed since.",
  risk: (distance, tail) => `${distance} off on average in ${tail} of what the person may mean`,
  plan: { takes: "The place it takes", likely: "The most likely place", outcome: "Outcome", may: "May it move", none: "none" },
  outcomes: {
    planned: "A motion there is planned", no_free_place: "There is no free place", unreachable: "The arm reaches no free place", no_path: "No collision-free motion was found", no_robot: "There is no robot to move",
    start_in_collision: "The arm touches something where it is", goal_in_collision: "The arm would touch something at every free place", joints_unknown: "Where the arm is, is not known", outside_limits: "A joint of the arm is outside its limits", cannot_pick: "The arm cannot pick it up", unknown: "What became of the plan is not known",
  },
  outcome: (outcome, motion_s) => `${outcome}${motion_s === null ? "" : `, in ${motion_s.toFixed(1)} s`}`,
  mayMove: { yes: "Yes: for this table the bound is below the goal.", no: "No: for this table the bound is not known to be below the goal." },
  picture: (name, hasNumbers, hasSquare) => `The table from above, the robot's side below. Black: where the robot would put the ${name}.${hasNumbers ? " Numbers: the places below." : ""}${hasSquare ? " Square: the most likely place." : ""}`,
  considered: "Places that were considered, best first",
  verdicts: { chosen: "chosen", next_best: "next best", unreachable: "out of reach", no_path: "no way there", blocked: "blocked", unknown: "not known" },
  candidate: { left: "From the left", edge: "From the robot's edge", verdict: "Verdict", why: "Why", free: "Free space around", off: "Off in the worst case", best: "Best for" },
  note: (tail) => `Off in the worst case: the mean distance to the person's place in ${tail} of what the person may mean. Best for: the share of these whose best place is near.`,
  balance: (average, worst, isChosen) => `The average counts ${average}, the worst case ${worst}, ${isChosen ? "as the person chose" : "as it was set"}.`,
  gridKey: `${WORLD.gridKey} Green: where it ends.`,
  wants: "What it takes the person to want",
  worth: "What each feature is worth: the mean of the draws, and where nine in ten of them lie",
  most: (shown, all) => `These ${shown} of ${all} features weigh most`,
  weights: { feature: "Feature", mean: "Mean", range: "Nine in ten between", bar: "Left: worth less; right: worth more" },
  range: (low, high) => `${low} to ${high}`,
  receipt: "What the claim rests on",
  made: "Made by the operator page from what it knew at that time.",
  receiptNames: { bound: "Revision of the bound", answers: "Revision of the answers", world: "World, SHA-256" },
};

// ---- the words in index.html --------------------------------------------------------------------------------------

const GROUPS = { bar: BAR, states: STATES, link: LINK, session: SESSION, dialog: DIALOG, question: QUESTION, gauge: GAUGE, answer: ANSWER, answers: ANSWERS, progress: PROGRESS, table: TABLE, carry: CARRY, world: WORLD, weights: WEIGHTS, caution: CAUTION, ask: WORDS };
const ATTRIBUTES = { "data-words-label": "aria-label", "data-words-title": "title", "data-words-short": "data-short" };

/** Writes these words over those of index.html, which are there for the moment before this script runs; what the page says without scripts stands there alone. */
export function fillWords() {
  const said = (path) => { const [group, name] = path.split("."); return GROUPS[group][name]; };
  document.documentElement.lang = LANGUAGE;
  // Style sheets take words only this way: for the head of each sheet of the report on paper.
  document.documentElement.style.setProperty("--report-title", JSON.stringify(REPORT.title));
  for (const node of document.querySelectorAll("[data-words]")) if (node.textContent !== said(node.dataset.words)) node.textContent = said(node.dataset.words);
  for (const [from, to] of Object.entries(ATTRIBUTES)) for (const node of document.querySelectorAll(`[${from}]`)) node.setAttribute(to, said(node.getAttribute(from)));
}
