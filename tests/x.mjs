import {Scene} from 'morse-smooth/snapshot';
function torus(a,c){const P=[],T=[];for(let i=0;i<a;i++)for(let j=0;j<c;j++){const u=2*Math.PI*(i+.3)/a,v=2*Math.PI*(j+.2)/c,r=2+Math.cos(v);P.push(Math.sin(v),r*Math.cos(u),r*Math.sin(u));const [A,B]=[i*c,((i+1)%a)*c],k=(j+1)%c;T.push(A+j,B+j,B+k,A+j,B+k,A+k)}return{P,T}}
const {P,T}=torus(316,158); const f=Float64Array.from({length:P.length/3},(_,i)=>P[3*i+2]+.3*Math.sin(9*P[3*i])*Math.cos(7*P[3*i+1]));
let t=performance.now(); const s=new Scene(P,T); console.log('scene',performance.now()-t);

for (const o of [{levels:[],criticalPoints:false},{levels:{count:15}},{levels:{count:30},morseComplex:true}]) { const ts=[]; for(let k=0;k<5;k++){t=performance.now(); s.snapshot(f,o); ts.push((performance.now()-t).toFixed(0));} console.log(JSON.stringify(o),ts.join(' '));}
