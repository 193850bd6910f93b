#include "audit/report.hpp"

namespace cleancolor {
std::string audit_html(std::span<const AuditedFile>, const ReportOptions&) { return ""; }
}
