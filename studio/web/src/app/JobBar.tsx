import { IconButton } from "../ui/IconButton";
import { cancelJob, jobs } from "../ui/job";

/** What the server works on, how far it is, and cancel; its position is kept so that nothing moves when work comes or goes. */
export function JobBar() {
  const shown = jobs.value;
  return (
    <section class="jobs" aria-label="Work in progress" data-testid="jobs">
      {shown.length === 0 && <span class="job-stage">No work in progress</span>}
      {shown.map((job) => (
        <div key={job.id} class="job">
          <span class="job-title">{job.title}</span>
          <progress aria-label={job.title} max={1} value={job.state === "running" && job.fraction >= 0 ? job.fraction : undefined} />
          <span class="job-stage">{job.state === "waiting" ? "waiting" : job.stage}</span>
          <IconButton icon="close" label={`Cancel: ${job.title}`} onClick={() => cancelJob(job.id)} />
        </div>
      ))}
    </section>
  );
}
