// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als::detail {

/// Style of the page: a column for reading, tables that scroll in themselves on narrow screens, the
/// reader's light or dark theme (its colours are those of Canvas::themeStyle()), and for paper no
/// colours that ink is wasted on and no picture cut by a page's end.
inline constexpr const char* kReportStyle = R"(
:root{color-scheme:light dark;--note:#555;--rule:#888;--attention:#e69f00;--bad:#b2182b}
@media screen and (prefers-color-scheme:dark){:root{--note:#b4b4b2;--rule:#77797b;--bad:#f0686f}}
body{margin:0;background:var(--ground);color:var(--black);font:16px/1.5 "DejaVu Sans",Verdana,Helvetica,sans-serif}
main{max-width:1080px;margin:0 auto;padding:24px 32px 48px;background:var(--white)}
h1{font-size:26px;line-height:1.25;margin:8px 0 20px}
h2{font-size:19px;margin:36px 0 10px;padding-bottom:4px;border-bottom:1px solid var(--faint)}
#verdict{border-left:10px solid;padding:12px 20px;background:var(--ground)}
#verdict.good{border-color:var(--after)}#verdict.attention{border-color:var(--attention)}
#verdict.bad{border-color:var(--bad)}
.headline{font-size:19px;font-weight:bold;margin:4px 0 8px}
#verdict ul{margin:4px 0;padding-left:22px}
.wide{overflow-x:auto;margin:12px 0}
table{border-collapse:collapse;font-size:14px}
caption{text-align:left;color:var(--note);padding:4px 0}
th,td{padding:4px 12px;border-bottom:1px solid var(--faint);text-align:left;vertical-align:top}
th{border-bottom:2px solid var(--rule)}
th,td:first-child{white-space:nowrap}
tr.failed td{color:var(--bad);font-weight:bold}
nav{margin:16px 0 0;font-size:14px}nav a{margin-right:14px}a{color:var(--after)}
th button{all:unset;cursor:pointer}th button:focus-visible{outline:2px solid var(--after)}
th[aria-sort=ascending] button::after{content:" ▲"}th[aria-sort=descending] button::after{content:" ▼"}
input[type=search]{font:inherit;font-size:14px;padding:4px 8px;margin:12px 0 0}
th.n{text-align:right}td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
figure{margin:18px 0}
figure>svg{display:block;max-width:100%;height:auto;border:1px solid var(--faint)}
figcaption{color:var(--note);font-size:14px}
footer{margin-top:40px;color:var(--note);font-size:13px}
@page{margin:15mm}
@media (max-width:700px){main{padding:16px 12px 32px}}
@media print{body,#verdict{background:#fff}main{max-width:none;padding:0}
figure,tr,#verdict{break-inside:avoid}h2{break-after:avoid}.wide{overflow:visible}nav,input{display:none}
thead{display:table-header-group}table{font-size:11px}th,td{padding:2px 8px}a{color:inherit}}
)";

/// Headings of tables with several rows become buttons that sort by their column; tables of more
/// than 30 rows get a field that shows the rows with a text.
inline constexpr const char* kReportScript = R"(
document.querySelectorAll('.wide table').forEach(function (table) {
  var body = table.tBodies[0], rows = Array.prototype.slice.call(body.rows);
  if (rows.length < 3) return;
  function value(row, column) {
    var cell = row.cells[column], text = cell ? cell.textContent.replace(/\u2212/g, '-') : '';
    var number = parseFloat(text.replace(/(\d) (?=\d)/g, '$1'));
    return isNaN(number) || !/^[-+]?[\d.]/.test(text) ? text : number;
  }
  Array.prototype.forEach.call(table.tHead.rows[0].cells, function (head, column) {
    var button = document.createElement('button');
    button.textContent = head.textContent;
    head.textContent = '';
    head.appendChild(button);
    button.addEventListener('click', function () {
      var down = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
      Array.prototype.forEach.call(table.tHead.rows[0].cells, function (other) {
        other.removeAttribute('aria-sort');
      });
      head.setAttribute('aria-sort', down === 1 ? 'ascending' : 'descending');
      rows.slice().sort(function (a, b) {
        var x = value(a, column), y = value(b, column);
        if (typeof x !== typeof y) return typeof x === 'number' ? -1 : 1;
        return down * (typeof x === 'number' ? x - y : x.localeCompare(y, 'en', {numeric: true}));
      }).forEach(function (row) { body.appendChild(row); });
    });
  });
  if (rows.length <= 30) return;
  var filter = document.createElement('input');
  filter.type = 'search';
  filter.placeholder = 'filter rows';
  filter.setAttribute('aria-label', 'Show the rows that contain a text');
  filter.addEventListener('input', function () {
    var text = filter.value.toLowerCase();
    rows.forEach(function (row) {
      row.hidden = row.textContent.toLowerCase().indexOf(text) < 0;
    });
  });
  table.parentNode.parentNode.insertBefore(filter, table.parentNode);
});
)";

}  // namespace pcl_als::detail
