#include "mesher/outline/dxf_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/files/text_words.hpp"

namespace weaveform {

const DxfPair* DxfEntity::find(int code) const {
  const auto found = std::find_if(pairs.begin(), pairs.end(), [code](const DxfPair& p) { return p.code == code; });
  return found == pairs.end() ? nullptr : &*found;
}

std::string DxfEntity::text(int code) const {
  const DxfPair* pair = find(code);
  return pair == nullptr ? "" : std::string(pair->value);
}

namespace {

// mm; by the number that $INSUNITS holds. 0 is no unit.
const std::map<long, double> unit_length = {{1, 25.4},    {2, 304.8},  {4, 1.0},    {5, 10.0},  {6, 1000.0},
                                            {8, 2.54e-5}, {9, 0.0254}, {10, 914.4}, {13, 1e-3}, {14, 100.0}};

[[noreturn]] void fail(const std::string& file, int line, const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}", file, line, what));
}

class Pairs {
public:
  Pairs(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  // The next pair; comments are passed over. Throws where the file ends.
  DxfPair next() {
    while (true) {
      const std::string_view code = line();
      DxfPair pair;
      long number = 0;
      if (!read_whole(code, number).empty() || number < -10 || number > 2000)
        fail(file_, line_,
             fmt::format("'{}' where a group code (a whole number) is expected; is this a DXF file?",
                         code.substr(0, 40)));
      pair.code = static_cast<int>(number);
      pair.value = line();
      pair.line = line_;
      if (pair.code != 999) return pair;
    }
  }

private:
  std::string_view line() {
    if (next_ >= text_.size())
      fail(file_, line_, "the file ends without EOF; it may have been cut short, write it again");
    const std::size_t end = std::min(text_.find('\n', next_), text_.size());
    std::string_view found = text_.substr(next_, end - next_);
    next_ = end + 1;
    ++line_;
    if (!found.empty() && found.back() == '\r') found.remove_suffix(1);
    return trimmed(found);
  }
  std::string_view text_;
  const std::string& file_;
  std::size_t next_ = 0;
  int line_ = 0;
};

class DrawingReader {
public:
  DrawingReader(std::string_view text, const std::string& file) : in_(text, file) { drawing_.file = file; }

  DxfDrawing read() {
    at_ = in_.next();
    while (!begins("EOF")) {
      if (!begins("SECTION"))
        fail(drawing_.file, at_.line,
             fmt::format("'{}' where a SECTION is expected; is this a DXF file?", at_.value.substr(0, 40)));
      at_ = in_.next();
      const std::string name(at_.value);
      at_ = in_.next();
      if (name == "HEADER")
        read_header();
      else if (name == "TABLES")
        read_layers();
      else if (name == "BLOCKS")
        read_blocks();
      else if (name == "ENTITIES")
        drawing_.entities = read_entities("ENDSEC");
      while (!begins("ENDSEC")) at_ = in_.next();
      at_ = in_.next();
    }
    return std::move(drawing_);
  }

private:
  [[nodiscard]] bool begins(std::string_view word) const { return at_.code == 0 && at_.value == word; }

  void read_header() {
    for (; !begins("ENDSEC"); at_ = in_.next()) {
      if (at_.code != 9 || at_.value != "$INSUNITS") continue;
      at_ = in_.next();
      const long number = dxf_whole(drawing_, at_);
      const auto found = unit_length.find(number);
      if (found != unit_length.end())
        drawing_.unit = found->second;
      else if (number != 0)
        fail(drawing_.file, at_.line,
             fmt::format("$INSUNITS {}: the drawing's unit is none that cloth is cut in; save it in mm", number));
    }
  }

  // An entity and what belongs to it, up to the next.
  DxfEntity read_entity() {
    DxfEntity entity;
    entity.type = upper(at_.value);
    entity.line = at_.line;
    for (at_ = in_.next(); at_.code != 0; at_ = in_.next()) entity.pairs.push_back(at_);
    return entity;
  }

  void read_layers() {
    while (!begins("ENDSEC")) {
      const DxfEntity entry = read_entity();
      if (entry.type != "LAYER" || entry.find(2) == nullptr) continue;
      const bool off = dxf_whole(drawing_, entry, 62, 7) < 0, frozen = (dxf_whole(drawing_, entry, 70, 0) & 1) != 0;
      if (off || frozen) drawing_.hidden.insert(upper(entry.text(2)));
    }
  }

  std::vector<DxfEntity> read_entities(std::string_view end) {
    std::vector<DxfEntity> entities;
    while (!begins(end) && !begins("ENDSEC")) {
      DxfEntity entity = read_entity();
      if (entity.type == "POLYLINE") {
        while (begins("VERTEX")) entity.vertices.push_back(read_entity());
        if (begins("SEQEND")) (void)read_entity();
      }
      if (dxf_whole(drawing_, entity, 67, 0) == 0) entities.push_back(std::move(entity));
    }
    return entities;
  }

  void read_blocks() {
    while (!begins("ENDSEC")) {
      const DxfEntity head = read_entity();
      if (head.type != "BLOCK") continue;
      DxfBlock block;
      block.base = {dxf_real(drawing_, head, 10, 0.0), dxf_real(drawing_, head, 20, 0.0)};
      block.entities = read_entities("ENDBLK");
      drawing_.blocks[upper(head.text(2))] = std::move(block);
    }
  }

  Pairs in_;
  DxfDrawing drawing_;
  DxfPair at_;
};

}  // namespace

double dxf_real(const DxfDrawing& drawing, const DxfPair& pair) {
  double value = 0.0;
  const std::string trouble = read_real(pair.value, value);
  if (!trouble.empty()) fail(drawing.file, pair.line, fmt::format("{} (group {})", trouble, pair.code));
  return value;
}

long dxf_whole(const DxfDrawing& drawing, const DxfPair& pair) {
  long value = 0;
  const std::string trouble = read_whole(pair.value, value);
  if (!trouble.empty()) fail(drawing.file, pair.line, fmt::format("{} (group {})", trouble, pair.code));
  return value;
}

double dxf_real(const DxfDrawing& drawing, const DxfEntity& entity, int code, double otherwise) {
  const DxfPair* pair = entity.find(code);
  return pair == nullptr ? otherwise : dxf_real(drawing, *pair);
}

long dxf_whole(const DxfDrawing& drawing, const DxfEntity& entity, int code, long otherwise) {
  const DxfPair* pair = entity.find(code);
  return pair == nullptr ? otherwise : dxf_whole(drawing, *pair);
}

DxfDrawing read_drawing(std::string_view text, const std::string& file) {
  if (text.rfind("AutoCAD Binary DXF", 0) == 0)
    throw InputError(file + ": a binary DXF file; save it as text (ASCII) DXF");
  if (text.rfind("AC10", 0) == 0) throw InputError(file + ": a DWG file; save it as DXF");
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.rfind(byte_order_mark, 0) == 0) text.remove_prefix(byte_order_mark.size());
  return DrawingReader(text, file).read();
}

}  // namespace weaveform
