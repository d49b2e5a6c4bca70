// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/binding/certify.h"

#include <span>
#include <utility>

#include "gnomon/oracle/verdict.h"
#include "gnomon/result/read_claims.h"
#include "python/binding/run_options.h"
#include "report/certificate/certificate.h"
#include "report/text/text_sink.h"

namespace gnomon::python {

namespace {

Expected<Judgement> judge(const LoadedScene& loaded, const std::vector<std::uint32_t>& lights,
                          const Claims& claims, const Limits& limits,
                          const std::atomic<bool>& stop) {
  report::Certificate certificate = report::certificate_of(loaded.scene, loaded.prepared, lights);
  oracle::CertifyOptions options = report::certify_options(limits, loaded.prepared, lights);
  options.threads = usable_jobs(limits.jobs);
  options.interrupted = &stop;
  auto verdict = oracle::certify(loaded.scene, loaded.prepared, claims, options);
  if (!verdict) return tl::unexpected(std::move(verdict.error()));
  report::JudgedRun run = report::foreign_run(claims.name, claims);
  run.report = *std::move(verdict);
  certificate.runs.push_back(std::move(run));
  report::StringSink json;
  report::write_certificate_json(json, certificate, false);
  return Judgement{report::certificate_text(certificate), json.text()};
}

}  // namespace

Expected<Judgement> certify(const LoadedScenePtr& loaded, const AskedLights& lights,
                            const std::string& result, const std::string& name,
                            const Limits& limits, const std::atomic<bool>& stop) {
  auto of_call = lights_of_call(loaded, lights, limits.jobs, stop);
  if (!of_call) return tl::unexpected(std::move(of_call.error()));
  auto claims = parse_claims(result, name, of_call->scene->scene, SharesAlone::kTaken);
  if (!claims) return tl::unexpected(std::move(claims.error()));
  return judge(*of_call->scene, of_call->lights, *claims, limits, stop);
}

Expected<Judgement> certify(const Shadows& shadows, const Limits& limits,
                            const std::atomic<bool>& stop) {
  return judge(*shadows.scene(), shadows.asked(), shadows.claims(), limits, stop);
}

}  // namespace gnomon::python
