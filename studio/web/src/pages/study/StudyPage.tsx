import { useEffect } from "preact/hooks";
import { PageLayout } from "../../ui/PageLayout";
import { SoundPanel } from "../feel/SoundPanel";
import { followFeel } from "../feel/feelStore";
import { ResultsView } from "./ResultsView";
import { SessionView } from "./SessionView";
import { BeginPanel, FilePanel, PresentationPanel, QuestionPanel, StimuliPanel } from "./SetupPanels";
import { followStudy, studyStatus } from "./studyStore";
import "../feel/feel.css";
import "./study.css";

/** Textures in random order, and what people say of them. */
export default function StudyPage() {
  useEffect(followFeel, []);
  useEffect(followStudy, []);
  const status = studyStatus.value;
  if (status?.session) {
    return (
      <PageLayout title="Study" results={<>{status.session.device === "mouse" && <SoundPanel />}</>}>
        <SessionView status={status} session={status.session} />
      </PageLayout>
    );
  }
  return (
    <PageLayout
      title="Study"
      side={
        <>
          <BeginPanel />
          <QuestionPanel />
          <StimuliPanel />
          <PresentationPanel />
          <FilePanel />
        </>
      }
    >
      {status?.problem && (
        <p class="study-problem" role="alert">
          {status.problem}. {status.hint}
        </p>
      )}
      <ResultsView />
    </PageLayout>
  );
}
