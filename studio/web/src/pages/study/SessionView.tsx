import { useEffect, useRef, useState } from "preact/hooks";
import type { Block } from "../../net/block";
import { call, link } from "../../net/connection";
import { attempt, Button } from "../../ui/Button";
import { useKeys, type Key } from "../../ui/keys";
import { commandsRun, feelStatus } from "../feel/feelStore";
import { FeelView } from "../feel/FeelView";
import { adviceOf, answerOfKey, answersWords, pauseWords, progressWords, RATINGS, type Session, type StudyStatus } from "./study";
import { giveAnswer, toggleTouch } from "./studyStore";

const kDeepest_m = 0.02;
const kDepth_m = 0.004;

const takeBack = () => call("study.take_back");
const end = () => call("study.end");
const resume = () => call("study.resume");

/** A session as the participant sees it: the question, the tiles, the answers. */
export function SessionView({ status, session }: { status: StudyStatus; session: Session }) {
  return (
    <section class="study-session" aria-label={`Session of ${session.participant}`} data-testid="study-session" data-phase={status.phase}>
      {status.problem && (
        <p class="study-problem" role="alert">
          {status.problem}. {status.hint}
        </p>
      )}
      {status.phase === "running" && <TrialView session={session} />}
      {status.phase === "paused" && <Pause status={status} session={session} />}
      {status.phase === "finished" && <Finish session={session} />}
    </section>
  );
}

function TrialView({ session }: { session: Session }) {
  const place = useRef<HTMLDivElement>(null);
  const [block, setBlock] = useState<Block | null>(null);
  const [depth_m, setDepth] = useState(kDepth_m);
  useEffect(() => {
    if (link.value !== "open") return;
    let newest = true;
    void attempt(async () => {
      const next = await call<Block>("study.open");
      if (newest) setBlock(next);
    });
    return () => void (newest = false);
  }, [link.value]);

  const touch = () => toggleTouch(session);
  const answer = async (value: number) => {
    // Space is for the touch again, not for the button that was clicked.
    place.current?.focus();
    await giveAnswer(session, value);
  };
  const isRating = session.method === "rating";
  useKeys(
    [
      { key: "space", label: session.touching ? "stop touching" : "touch", run: touch },
      ...answerKeys(isRating, answer),
      { key: "backspace", label: "withdraw the last answer", run: () => session.may_take_back && takeBack() },
      { key: "p", label: "pause", run: () => call("study.pause") },
    ],
    "Study",
  );
  // The picture has digits and arrows for its views, which stay as they are here; with a pointer, arrows for the touch.
  const beforeView = (event: KeyboardEvent) => {
    if (!(event.target instanceof HTMLCanvasElement) || event.ctrlKey || event.altKey || event.metaKey) return;
    const isArrow = event.key.startsWith("Arrow");
    if (!isArrow && !/^[0-9]$/.test(event.key)) return;
    if (isArrow && session.device === "mouse" && commandsRun()) return;
    event.preventDefault();
    event.stopPropagation();
    const value = answerOfKey(session.method, event.key);
    if (value !== null && !event.repeat) void attempt(() => answer(value));
  };
  return (
    <div class="study-trial" ref={place} tabIndex={-1} onKeyDownCapture={beforeView}>
      <header class="study-head">
        <h2 data-testid="study-asked">{session.question}</h2>
        <p data-testid="study-progress">
          {progressWords(session)} {session.of !== null && <progress max={session.of} value={session.answers} aria-label="Answers given" />}
        </p>
      </header>
      {isRating && session.object && <p>The real one: {session.object}</p>}
      <div class="study-view">
        <FeelView block={block} depth_m={depth_m} deepest_m={kDeepest_m} onDepth={setDepth} blind />
      </div>
      <p class="study-advice" role="status" data-testid="study-advice">
        {adviceOf(session, feelStatus.value?.held ?? true)}
      </p>
      <div class={isRating ? "study-answers study-ratings" : "study-answers"} role="group" aria-label={session.question}>
        {isRating ? (
          RATINGS.map((value) => (
            <Button key={value} onClick={() => answer(value)} disabled={!session.may_answer} label={`${value} of 7`} testId={`study-answer-${value}`}>
              {value}
            </Button>
          ))
        ) : (
          <>
            <Button onClick={() => answer(0)} disabled={!session.may_answer} testId="study-answer-a">
              <kbd>1</kbd> A, left{session.touched_a && <span class="study-mark"> ✓<span class="visually-hidden"> touched</span></span>}
            </Button>
            <Button onClick={() => answer(1)} disabled={!session.may_answer} testId="study-answer-b">
              <kbd>2</kbd> B, right{session.touched_b && <span class="study-mark"> ✓<span class="visually-hidden"> touched</span></span>}
            </Button>
          </>
        )}
      </div>
      {isRating && (
        <p class="study-ends">
          <span>1: not like it at all</span>
          <span>7: just like it</span>
        </p>
      )}
      <div class="buttons">
        <Button kind={session.touching ? "plain" : "primary"} onClick={touch} testId="study-touch">
          {session.touching ? "Stop touching" : "Touch"}
        </Button>
        <Button onClick={takeBack} disabled={!session.may_take_back} testId="study-take-back">
          Withdraw the last answer
        </Button>
        <Button onClick={() => call("study.pause")} testId="study-pause">
          Pause
        </Button>
        <Button onClick={end} hint="The log is kept, and the session can be continued" testId="study-end">
          End
        </Button>
      </div>
    </div>
  );
}

function answerKeys(isRating: boolean, answer: (value: number) => Promise<void>): Key[] {
  if (isRating) return RATINGS.map((value) => ({ key: String(value), label: `rate ${value}`, run: () => answer(value) }));
  return [
    { key: "1", label: "answer A", run: () => answer(0) },
    { key: "arrowleft", label: "answer A", run: () => answer(0) },
    { key: "2", label: "answer B", run: () => answer(1) },
    { key: "arrowright", label: "answer B", run: () => answer(1) },
  ];
}

function Pause({ status, session }: { status: StudyStatus; session: Session }) {
  useKeys(
    [
      { key: "space", label: "continue", run: resume },
      { key: "backspace", label: "withdraw the last answer", run: () => session.may_take_back && takeBack() },
    ],
    "Study",
  );
  return (
    <div class="study-rest" role="status">
      <h2>{pauseWords(status.why)}</h2>
      <p>
        {answersWords(session.answers)} given{session.of !== null && ` of ${session.of}`}; the log is {status.log}. Press Space when you are ready.
      </p>
      <div class="buttons">
        <Button kind="primary" onClick={resume} testId="study-resume">
          Continue
        </Button>
        <Button onClick={takeBack} disabled={!session.may_take_back}>
          Withdraw the last answer
        </Button>
        <Button onClick={end} hint="The log is kept, and the session can be continued" testId="study-end">
          End
        </Button>
      </div>
    </div>
  );
}

function Finish({ session }: { session: Session }) {
  useKeys([{ key: "backspace", label: "withdraw the last answer", run: () => session.may_take_back && takeBack() }], "Study");
  return (
    <div class="study-rest" role="status">
      <h2>That was the last one. Thank you.</h2>
      <p>{answersWords(session.answers)} given.</p>
      <div class="buttons">
        <Button kind="primary" onClick={end} testId="study-show">
          End and show the results
        </Button>
        <Button onClick={takeBack} disabled={!session.may_take_back} testId="study-take-back">
          Withdraw the last answer
        </Button>
      </div>
    </div>
  );
}
