// What gmsh.h declares and we call, each passed on to the function of the same name in the library. The names are those
// of the Itanium ABI, as `nm -D` shows them; one that is not there is an error that says so.
#include "mesher/tools/late_gmsh.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmsh.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace {

void* library() {
  static void* const loaded = [] {
    void* const library = dlopen(WEAVEFORM_GMSH_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr)
      throw weaveform::FileError(
          fmt::format("Gmsh cannot be loaded ({}); install its library {}, or give geometry as STL", dlerror(),
                      WEAVEFORM_GMSH_LIBRARY));
    return library;
  }();
  return loaded;
}

// A function of the library's with these arguments.
template <class... Arguments>
class Late {
public:
  explicit Late(const char* symbol) : function_(reinterpret_cast<Function>(dlsym(library(), symbol))) {
    if (function_ == nullptr)
      throw weaveform::FileError(
          fmt::format("{} is not the version of Gmsh that this program was built for: it has no {}",
                      WEAVEFORM_GMSH_LIBRARY, symbol));
  }
  void operator()(Arguments... arguments) const { function_(std::forward<Arguments>(arguments)...); }

private:
  using Function = void (*)(Arguments...);
  Function function_;
};

using Doubles = std::vector<double>;
using Ints = std::vector<int>;
using Pairs = gmsh::vectorpair;
using Tags = std::vector<std::size_t>;

}  // namespace

namespace weaveform {

void load_gmsh() {
  (void)library();
}

}  // namespace weaveform

namespace gmsh {

void initialize(int a, char** b, bool c) {
  static const Late<int, char**, bool> late("_ZN4gmsh10initializeEiPPcb");
  late(a, b, c);
}

void merge(const std::string& a) {
  static const Late<const std::string&> late("_ZN4gmsh5mergeERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE");
  late(a);
}

void write(const std::string& a) {
  static const Late<const std::string&> late("_ZN4gmsh5writeERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE");
  late(a);
}

}  // namespace gmsh

namespace gmsh::logger {

void get(std::vector<std::string>& a) {
  static const Late<std::vector<std::string>&> late(
      "_ZN4gmsh6logger3getERSt6vectorINSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEESaIS7_EE");
  late(a);
}

void start() {
  static const Late<> late("_ZN4gmsh6logger5startEv");
  late();
}

}  // namespace gmsh::logger

namespace gmsh::model {

void getBoundary(const Pairs& a, Pairs& b, bool c, bool d, bool e) {
  static const Late<const Pairs&, Pairs&, bool, bool, bool> late(
      "_ZN4gmsh5model11getBoundaryERKSt6vectorISt4pairIiiESaIS3_EERS5_bbb");
  late(a, b, c, d, e);
}

void getBoundingBox(int a, int b, double& c, double& d, double& e, double& f, double& g, double& h) {
  static const Late<int, int, double&, double&, double&, double&, double&, double&> late(
      "_ZN4gmsh5model14getBoundingBoxEiiRdS1_S1_S1_S1_S1_");
  late(a, b, c, d, e, f, g, h);
}

void getDerivative(int a, int b, const Doubles& c, Doubles& d) {
  static const Late<int, int, const Doubles&, Doubles&> late("_ZN4gmsh5model13getDerivativeEiiRKSt6vectorIdSaIdEERS3_");
  late(a, b, c, d);
}

void getEntities(Pairs& a, int b) {
  static const Late<Pairs&, int> late("_ZN4gmsh5model11getEntitiesERSt6vectorISt4pairIiiESaIS3_EEi");
  late(a, b);
}

void getParametrizationBounds(int a, int b, Doubles& c, Doubles& d) {
  static const Late<int, int, Doubles&, Doubles&> late(
      "_ZN4gmsh5model24getParametrizationBoundsEiiRSt6vectorIdSaIdEES4_");
  late(a, b, c, d);
}

void getType(int a, int b, std::string& c) {
  static const Late<int, int, std::string&> late(
      "_ZN4gmsh5model7getTypeEiiRNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE");
  late(a, b, c);
}

void getValue(int a, int b, const Doubles& c, Doubles& d) {
  static const Late<int, int, const Doubles&, Doubles&> late("_ZN4gmsh5model8getValueEiiRKSt6vectorIdSaIdEERS3_");
  late(a, b, c, d);
}

}  // namespace gmsh::model

namespace gmsh::model::mesh {

void clear(const Pairs& a) {
  static const Late<const Pairs&> late("_ZN4gmsh5model4mesh5clearERKSt6vectorISt4pairIiiESaIS4_EE");
  late(a);
}

void generate(int a) {
  static const Late<int> late("_ZN4gmsh5model4mesh8generateEi");
  late(a);
}

void getElements(Ints& a, std::vector<Tags>& b, std::vector<Tags>& c, int d, int e) {
  static const Late<Ints&, std::vector<Tags>&, std::vector<Tags>&, int, int> late(
      "_ZN4gmsh5model4mesh11getElementsERSt6vectorIiSaIiEERS2_IS2_ImSaImEESaIS7_EESA_ii");
  late(a, b, c, d, e);
}

void getNodes(Tags& a, Doubles& b, Doubles& c, int d, int e, bool f, bool g) {
  static const Late<Tags&, Doubles&, Doubles&, int, int, bool, bool> late(
      "_ZN4gmsh5model4mesh8getNodesERSt6vectorImSaImEERS2_IdSaIdEES8_iibb");
  late(a, b, c, d, e, f, g);
}

void refine() {
  static const Late<> late("_ZN4gmsh5model4mesh6refineEv");
  late();
}

void removeConstraints(const Pairs& a) {
  static const Late<const Pairs&> late("_ZN4gmsh5model4mesh17removeConstraintsERKSt6vectorISt4pairIiiESaIS4_EE");
  late(a);
}

void removeSizeCallback() {
  static const Late<> late("_ZN4gmsh5model4mesh18removeSizeCallbackEv");
  late();
}

void setSizeCallback(std::function<double(int, int, double, double, double)> a) {
  static const Late<std::function<double(int, int, double, double, double)>> late(
      "_ZN4gmsh5model4mesh15setSizeCallbackESt8functionIFdiidddEE");
  late(std::move(a));
}

}  // namespace gmsh::model::mesh

namespace gmsh::model::occ {

void getEntities(Pairs& a, int b) {
  static const Late<Pairs&, int> late("_ZN4gmsh5model3occ11getEntitiesERSt6vectorISt4pairIiiESaIS4_EEi");
  late(a, b);
}

void importShapesNativePointer(const void* a, Pairs& b, bool c) {
  static const Late<const void*, Pairs&, bool> late(
      "_ZN4gmsh5model3occ25importShapesNativePointerEPKvRSt6vectorISt4pairIiiESaIS6_EEb");
  late(a, b, c);
}

void synchronize() {
  static const Late<> late("_ZN4gmsh5model3occ11synchronizeEv");
  late();
}

}  // namespace gmsh::model::occ

namespace gmsh::option {

void setNumber(const std::string& a, double b) {
  static const Late<const std::string&, double> late(
      "_ZN4gmsh6option9setNumberERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEEd");
  late(a, b);
}

}  // namespace gmsh::option
