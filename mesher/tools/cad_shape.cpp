#include "mesher/tools/cad_shape.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TCollection_HAsciiString.hxx>
#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "mesher/tools/cad_progress.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_words = 5, longest_word = 160;

// Takes what OpenCASCADE would print.
class Listener : public Message_Printer {
public:
  [[nodiscard]] std::string take() { return std::move(heard_); }

private:
  void send(const TCollection_AsciiString& text, const Message_Gravity /*any*/) const override {
    constexpr std::size_t enough = 1 << 20;
    if (heard_.size() < enough) heard_ += std::string(text.ToCString()) + "\n";
  }
  mutable std::string heard_;
};

// Its check lists in a line each: a heading "Check:3 -- Entity (n0:id) 168:#168 Type:SURFACE_CURVE", below it what is
// wrong with that entity.
std::vector<std::string> complaints_in(const std::string& heard) {
  std::vector<std::string> words;
  std::string place;
  std::istringstream in(heard);
  for (std::string line; std::getline(in, line) && words.size() < most_words;) {
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, ' ');
    line.erase(0, line.find_first_not_of(' '));
    line.erase(line.find_last_not_of(' ') + 1);
    const bool is_heading = line.starts_with("Check:");
    if (is_heading) {
      place.clear();
      const std::size_t entity = line.find("(n0:id)");
      if (entity != std::string::npos && line.find("NULL") == std::string::npos) {
        std::istringstream fields(line.substr(entity + 7));
        std::string field;
        while (fields >> field) place += (place.empty() ? "entity " : " ") + field;
      }
    }
    // counts, headings and what merely tells are no complaints
    if (is_heading || line.empty() || line.find("Total number") != std::string::npos || line.find('*') == 0) continue;
    std::string word = (place.empty() ? line : place + ": " + line).substr(0, longest_word);
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(std::move(word));
  }
  return words;
}

InputError nothing_read(const fs::path& file, const char* kind, const std::vector<std::string>& words) {
  const std::string said =
      words.empty() ? "it says no more" : fmt::format("OpenCASCADE says: {}", fmt::join(words, "; "));
  return InputError(fmt::format("{}: no geometry can be read from this {} file ({}); write it again, or as STL",
                                file.string(), kind, said));
}

template <class Reader>
TopoDS_Shape transferred(Reader& reader, const fs::path& file) {
  const IFSelect_ReturnStatus status = reader.ReadFile(file.c_str());
  reader.PrintCheckLoad(false, IFSelect_ItemsByEntity);
  if (status != IFSelect_RetDone) return {};
  CadProgress progress(0.0, reading_share);
  (void)reader.TransferRoots(progress.start());
  reader.PrintCheckTransfer(false, IFSelect_ItemsByEntity);
  return reader.OneShape();
}

TopoDS_Shape read_as(CadFormat format, const fs::path& file) {
  if (format == CadFormat::step) {
    STEPControl_Reader reader;
    return transferred(reader, file);
  }
  if (format == CadFormat::iges) {
    IGESControl_Reader reader;
    return transferred(reader, file);
  }
  TopoDS_Shape shape;
  BRep_Builder builder;
  return BRepTools::Read(shape, file.c_str(), builder) ? shape : TopoDS_Shape();
}

}  // namespace

bool write_shape(const TopoDS_Shape& shape, CadFormat format, const fs::path& file) {
  if (format == CadFormat::brep) return BRepTools::Write(shape, file.c_str());
  if (format != CadFormat::step) return false;
  STEPControl_Writer writer;
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone) return false;
  // a file says in its beginning who wrote it, so that it can be written anew
  APIHeaderSection_MakeHeader(writer.Model()).SetName(new TCollection_HAsciiString(written_mark));
  return writer.Write(file.c_str()) == IFSelect_RetDone;
}

CadShape read_shape(CadFormat format, const fs::path& file) {
  const char* const kind = format == CadFormat::step ? "STEP" : format == CadFormat::iges ? "IGES" : "BREP";
  const Handle(Listener) listener = new Listener;
  const Handle(Message_Messenger)& messenger = Message::DefaultMessenger();
  messenger->ChangePrinters().Clear();
  messenger->AddPrinter(listener);
  CadShape result;
  std::string thrown;
  try {
    result.shape = read_as(format, file);
  } catch (const Standard_Failure& failure) {
    thrown = failure.GetMessageString();
  }
  result.words = complaints_in(listener->take());
  if (!thrown.empty()) result.words.push_back(thrown);
  const bool broken = std::any_of(result.words.begin(), result.words.end(), [](const std::string& word) {
    return word.find("Incorrect syntax") != std::string::npos;
  });
  if (broken || result.shape.IsNull()) throw nothing_read(file, kind, result.words);
  return result;
}

}  // namespace weaveform
