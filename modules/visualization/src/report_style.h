// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als::detail {

/// Style of the page: a column for reading, tables that scroll in themselves on narrow screens,
/// and for paper no colours that ink is wasted on and no picture cut by a page's end.
inline constexpr const char* kReportStyle = R"(
:root{color-scheme:light}
body{margin:0;background:#f4f4f2;color:#1a1a1a;font:16px/1.5 "DejaVu Sans",Verdana,Helvetica,sans-serif}
main{max-width:1080px;margin:0 auto;padding:24px 32px 48px;background:#fff}
h1{font-size:26px;line-height:1.25;margin:8px 0 20px}
h2{font-size:19px;margin:36px 0 10px;padding-bottom:4px;border-bottom:1px solid #ccc}
#verdict{border-left:10px solid;padding:12px 20px;background:#f4f4f2}
#verdict.good{border-color:#0072b2}#verdict.attention{border-color:#e69f00}#verdict.bad{border-color:#b2182b}
.headline{font-size:19px;font-weight:bold;margin:4px 0 8px}
#verdict ul{margin:4px 0;padding-left:22px}
.wide{overflow-x:auto;margin:12px 0}
table{border-collapse:collapse;font-size:14px}
caption{text-align:left;color:#555;padding:4px 0}
th,td{padding:4px 12px;border-bottom:1px solid #ddd;text-align:left;vertical-align:top}
th{border-bottom:2px solid #888}
th{white-space:nowrap}th.n{text-align:right}td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
figure{margin:18px 0}
img{max-width:100%;height:auto;border:1px solid #ddd}
figcaption{color:#555;font-size:14px}
footer{margin-top:40px;color:#666;font-size:13px}
@page{margin:15mm}
@media print{body,#verdict{background:#fff}main{max-width:none;padding:0}
figure,tr,#verdict{break-inside:avoid}h2{break-after:avoid}.wide{overflow:visible}
table{font-size:11px}th,td{padding:2px 8px}a{color:inherit}}
)";

}  // namespace pcl_als::detail
