#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include "neutral/laws.hpp"
#include "property/random_file.hpp"
#include "slapstick/base/error.hpp"
using namespace slapstick; using namespace slapstick::neutral;
static double now(){return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();}
int main(int argc,char**argv){
  const std::string what=argv[1]; long from=atol(argv[2]), to=atol(argv[3]);
  const double slow = argc>4?atof(argv[4]):1.0; 
  const std::string only = argc>5?argv[5]:"";
  std::map<std::string,std::map<std::string,int>> counts;
  for(long seed=from;seed<to;++seed){
    const Definition file=test::random_file((std::uint64_t)seed);
    if(what=="text"){ fputs(text(file).c_str(),stdout); continue; }
    if(what=="laws"){
      for(const Law& law: laws()){ if(!only.empty()&&only!=law.name) continue; double t=now(); fprintf(stderr,"seed %ld law %s\n",seed,law.name); auto b=check(law,read(file)); t=now()-t;
        if(t>slow) printf("SLOW seed %ld law %s %.2f s\n",seed,law.name,t);
        counts[law.name][!b?"nothing":b->empty()?"kept":"broken"]++;
        if(b&&!b->empty()) printf("BROKEN seed %ld %s: %s\n",seed,law.name,b->c_str());
        fflush(stdout);} continue; }
    Verb verb{}; bool any=false; for(Verb v:{Verb::simulate,Verb::measure,Verb::classify,Verb::orbit,Verb::branch,Verb::curve}) if(what==name(v)) verb=v,any=true;
    if(!any) return 2;
    Asked first(file);
    if(first.definition().parameters().size()<parameters_of(verb)) continue;
    double t=now(); fprintf(stderr,"seed %ld\n",seed); first.answer(verb); t=now()-t;
    if(t>slow) printf("SLOW seed %ld %s %.2f s\n",seed,name(verb),t);
    for(const Edit& e: edits()){ if(!only.empty()&&only!=e.name) continue;
      campaign::Random random((std::uint64_t)seed,0); auto second=e.apply(file,random); if(!second) continue;
      fprintf(stderr,"seed %ld %s\n",seed,e.name);
      double t=now(); Judgement j=judge(first,e,*second,verb); t=now()-t;
      if(t>slow) printf("SLOW seed %ld %s %s %.2f s\n",seed,name(verb),e.name,t);
      counts[e.name][name(j.verdict)]++; counts["all"][name(j.verdict)]++;
      if(j.verdict!=Verdict::agreed&&j.verdict!=Verdict::excluded) printf("%s seed %ld %s: %s\n",name(j.verdict),seed,e.name,j.why.c_str());
      if(argc>6&&j.verdict==Verdict::different){ auto s=smallest(file,e,verb,(std::uint64_t)seed,atoi(argv[6])); puts(both_commands(s,e,verb,(std::uint64_t)seed).c_str()); }
      fflush(stdout);
    }
  }
  for(auto&[e,m]:counts){ printf("%-22s",e.c_str()); for(auto&[v,n]:m) printf(" %s %d",v.c_str(),n); puts(""); }
}
