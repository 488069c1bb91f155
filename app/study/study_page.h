// Decides what a study says at its end: sentences, tables and figures of its page, and its facts for programs. Nothing
// of it depends on how often the work was interrupted or how long it took.
#pragma once

#include "app/study/study_merge.h"
#include "io/jobs/study_job.h"

namespace hysteron {

Document study_document(const StudyJob& job, const StudyProblem& problem, const StudyFolder& folder,
                        const MergedStudy& merged);

}  // namespace hysteron
