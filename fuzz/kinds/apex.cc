// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/kinds/apex.h"

namespace gnomon::fuzz {

namespace {

/// 1 if pq is nearer to the apex where the edges pq and rs cross, -1 if rs is, 0 if they do not
/// cross or meet there.
int nearer_at_crossing(const Apex& apex, const Integers& p, const Integers& q, const Integers& r,
                       const Integers& s) {
  const Integers pq = apex.plane(p, q), rs = apex.plane(r, s);
  const mpz_class at_p = dot(rs, minus(p, r)), at_q = dot(rs, minus(q, r));
  const mpz_class at_r = dot(pq, minus(r, p)), at_s = dot(pq, minus(s, p));
  if (sgn(at_r) * sgn(at_s) >= 0 || sgn(at_p) * sgn(at_q) >= 0) return 0;
  // Where pq crosses the plane of rs, and rs that of pq, times the same positive number.
  Integers on_pq, on_rs;
  for (std::size_t k = 0; k < 3; ++k) {
    on_pq[k] = (abs(at_q) * p[k] + abs(at_p) * q[k]) * (abs(at_r) + abs(at_s));
    on_rs[k] = (abs(at_s) * r[k] + abs(at_r) * s[k]) * (abs(at_p) + abs(at_q));
  }
  if (apex.weight == 0) return sgn(dot(minus(on_pq, on_rs), apex.p));
  const mpz_class scale = (abs(at_p) + abs(at_q)) * (abs(at_r) + abs(at_s));
  Integers apex_there;
  for (std::size_t k = 0; k < 3; ++k) apex_there[k] = apex.p[k] * scale;
  const Integers to_pq = minus(apex_there, on_pq), to_rs = minus(apex_there, on_rs);
  if (sgn(dot(to_pq, to_rs)) <= 0) return 0;  // on different sides of the apex
  return sgn(squared_length(to_rs) - squared_length(to_pq));
}

}  // namespace

bool on_shadow_edge(const Apex& apex, const Integers& a, const Integers& b, const Integers& c) {
  const Integers m = apex.plane(a, b);
  if (is_zero(m) || sgn(dot(m, minus(c, a))) != 0) return false;
  const Integers qa = apex.from(a), qb = apex.from(b), qc = apex.from(c);
  if (apex.weight == 1) {
    const Integers n = cross(qa, qb);
    return sgn(dot(n, cross(qa, qc))) > 0 && sgn(dot(n, cross(qc, qb))) > 0 && !collinear(a, b, c);
  }
  const Integers ac = cross(apex.p, minus(c, a)), cb = cross(apex.p, minus(b, c));
  return sgn(dot(m, ac)) > 0 && sgn(dot(m, cb)) > 0 && !collinear(a, b, c);
}

bool on_shadow_vertex(const Apex& apex, const Integers& a, const Integers& c) {
  if (a == c) return false;
  if (apex.weight == 0) return is_zero(cross(apex.p, minus(c, a)));
  const Integers qa = apex.from(a), qc = apex.from(c);
  return !is_zero(qa) && !is_zero(qc) && is_zero(cross(qa, qc)) && sgn(dot(qa, qc)) > 0;
}

int nearer(const Apex& apex, const Face& a, const Face& b) {
  int order = 0;
  any_edges(a, b, [&](const Integers& p, const Integers& q, const Integers& r, const Integers& s) {
    order = nearer_at_crossing(apex, p, q, r, s);
    return order != 0;
  });
  return order;
}

}  // namespace gnomon::fuzz
