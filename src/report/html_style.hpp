// Style and script of web pages, and how they begin. Colours are added from the themes.
#pragma once

#include <string>
#include <string_view>

namespace lantern::report {

inline constexpr std::string_view kPageStyle = R"css(
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif}
.page{display:grid;grid-template-columns:19rem minmax(0,1fr);gap:2.5rem;max-width:110rem;margin:0 auto;padding:1.5rem 2rem}
.side{position:sticky;top:0;align-self:start;max-height:100vh;overflow:auto;padding:1rem 0;font-size:.9rem}
h1{margin:0;font-size:1.7rem}h2{margin:0 0 .4rem;font-size:1.3rem}h3{margin:1rem 0 .3rem;font-size:1rem}
section{border-top:1px solid var(--rule);padding:1.6rem 0;scroll-margin-top:.5rem}
p{margin:.3rem 0;max-width:80ch}.quiet,figcaption,caption{color:var(--quiet)}
a{color:inherit}fieldset{border:0;margin:0 0 .8rem;padding:0}legend{font-weight:600;padding:0}
label{display:flex;gap:.4rem;align-items:center;padding:.08rem 0;cursor:pointer}
label .sample{flex:none}button{font:inherit;margin:0 .3rem .3rem 0}
:focus-visible{outline:2px solid var(--b4);outline-offset:2px}
.index{columns:3 14rem;padding:0;list-style:none;margin:.5rem 0 0}.index li{break-inside:avoid}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(27rem,100%),1fr));gap:1rem 2rem;margin:1rem 0 .5rem}
figure{margin:0}figcaption{font-size:.85rem}figcaption b{color:var(--ink);font-size:1rem}
.plot{display:block;width:100%;height:auto;font:13px system-ui,sans-serif}
.plot text{fill:var(--quiet)}.plot .name{fill:var(--ink)}
.area{fill:var(--panel);stroke:var(--rule)}.grid{stroke:var(--rule);stroke-width:.7}.edge{stroke:var(--quiet);stroke-dasharray:2 3}
.line{fill:none;stroke:var(--c);stroke-width:2}.peer .line{stroke-dasharray:6 4}
.mark{fill:var(--c);stroke:var(--line);stroke-width:.8}.open{fill:var(--panel);stroke:var(--c);stroke-width:2}
.whisker{fill:none;stroke:var(--c);stroke-width:5;opacity:.45}
.k1 .mark{fill:var(--panel);stroke:var(--c);stroke-width:1.8}.k1 .line{stroke-width:1}
.front{fill:none;stroke:var(--ink);stroke-width:6;opacity:.16}.guide{fill:none;stroke:var(--quiet);stroke-dasharray:1 4;stroke-width:1.5}
.sample{width:34px;height:14px}
.legend{display:flex;flex-wrap:wrap;gap:.1rem 1.2rem;list-style:none;padding:0;margin:.3rem 0;font-size:.9rem}.legend li{display:flex;gap:.4rem;align-items:center}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:.88rem;margin:.4rem 0}caption{text-align:left}
th,td{padding:.15rem .7rem .15rem 0;text-align:left;vertical-align:top}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
thead th{border-bottom:1px solid var(--ink);font-weight:600}tbody tr{border-bottom:1px solid var(--rule)}
.bad{color:var(--warning);font-weight:600}summary{cursor:pointer;margin:.4rem 0}
@media(max-width:60rem){.page{grid-template-columns:minmax(0,1fr);padding:1rem}.side{position:static;max-height:none}}
@media print{.side,summary,button{display:none}.page{display:block;padding:0}section{break-inside:avoid-page}body{font-size:10pt}}
)css";

// From the document's type to the marks of its plots. `rules` are added to the style.
std::string html_begin(std::string_view title, std::string_view rules);

// Buttons that choose for all boxes at once; made here, since without a script they would be dead.
inline constexpr std::string_view kPageScript = R"js(
const place=document.getElementById('buttons');
const boxes=[...document.querySelectorAll('input[name=method]')];
for(const [words,wanted] of [['All',()=>true],['None',()=>false],['Lantern only',b=>!b.dataset.peer]]){
const button=document.createElement('button');button.type='button';button.textContent=words;
button.onclick=()=>boxes.forEach(b=>{b.checked=wanted(b)});place.append(button);}
)js";

}  // namespace lantern::report
