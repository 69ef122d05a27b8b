#include "common/case/case_file.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <tuple>

#include "common/case/describe_table.hpp"
#include "common/case/document.hpp"
#include "common/case/nearest_word.hpp"
#include "common/case/overrides.hpp"
#include "common/case/read_table.hpp"
#include "common/case/text_file.hpp"
#include "common/case/text_hash.hpp"
#include "common/case/write_table.hpp"

namespace toryu {

struct CaseFile::Content {
  std::filesystem::path file;
  std::vector<std::filesystem::path> inputs;  ///< what was read
  std::string text;
  std::vector<std::string> overrides;
  toml::table root;
  toml::source_region start;  ///< of the file, where a missing section is reported
  std::vector<InputError> faults;
  std::vector<std::pair<std::string, InputError>> override_faults;  ///< by top-level section
  std::vector<std::string> left_sections;
  struct Section {
    std::string name, used, description;
  };
  std::vector<Section> sections;  ///< in the order in which they were read
};

namespace {

bool is_there(const toml::table& root, const std::string& section) {
  const toml::node* node = root.at_path(section).node();
  return node && node->value_exact<bool>() != false;
}

Kind kind_of(const toml::table& root) {
  if (root.contains("study")) return Kind::study;
  const bool fluid = is_there(root, "fluid"), solid = is_there(root, "solid");
  if (fluid && solid) return Kind::coupled;
  return fluid ? Kind::fluid : solid ? Kind::solid : Kind::empty;
}

/// Path, line and column of every key and of every table in a list, below `path`.
void add_places(const toml::node& node, const toml::array& path, toml::array& places) {
  const auto add = [&](const auto& part, const toml::source_region& place, const toml::node& inner) {
    toml::array here = path;
    here.push_back(part);
    places.push_back(toml::array(here, static_cast<std::int64_t>(place.begin.line),
                                 static_cast<std::int64_t>(place.begin.column)));
    add_places(inner, here, places);
  };
  if (const toml::table* table = node.as_table())
    for (const auto& [key, inner] : *table) add(std::string(key.str()), key.source(), inner);
  else if (const toml::array* array = node.as_array())
    for (std::size_t i = 0; i < array->size(); ++i)
      if (const toml::node& inner = *array->get(i); inner.is_table())
        add(static_cast<std::int64_t>(i), inner.source(), inner);
}

/// Under any key a text that ends as tables and drawings do, under `file` any.
void add_named_files(std::string_view key, const toml::node& node, const std::filesystem::path& folder,
                     std::set<std::string>& names) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [name, inner] : *table) add_named_files(name.str(), inner, folder, names);
  } else if (const toml::array* array = node.as_array()) {
    for (const toml::node& inner : *array) add_named_files("", inner, folder, names);
  } else if (const auto name = node.value_exact<std::string>()) {
    const auto ends = [&](const char* ending) { return name->ends_with(ending); };
    if ((key == "file" || ends(".csv") || ends(".svg") || ends(".dxf")) &&
        fault_of_name(folder, *name).empty())
      names.insert(*name);
  }
}

/// Parses `file` and, if it names a `base`, puts it into that. Appends what was read to `text` and `inputs`.
toml::table read_document(const std::filesystem::path& file, std::string& text,
                          std::vector<std::filesystem::path>& inputs) {
  text += read_text(file, largest_case);
  inputs.push_back(file);
  toml::table changes = parse_document(text, file.string());
  const auto entry = changes.find("base");
  if (entry == changes.end() || kind_of(changes) == Kind::study) return changes;
  const auto place = entry->first.source();
  const auto name = entry->second.value_exact<std::string>();
  const auto base = file.parent_path() / name.value_or("");
  if (!name || std::filesystem::path(*name).has_parent_path() || !is_file(base))
    throw BadInput(
        {fault_at(place, "'base' must name a case file beside this one, found " + found(entry->second))});
  changes.erase("base");
  const std::string base_text = read_text(base, largest_case);
  inputs.push_back(base);
  toml::table root = parse_document(base_text, base.string());
  if (const auto next = root.find("base"); next != root.end())
    throw BadInput({fault_at(next->first.source(),
                             "a case file that others have as their base cannot have one itself")});
  if (kind_of(root) == Kind::study) throw BadInput({fault_at(place, "'base' names a study, not a case")});
  text += base_text;
  merge_document(root, std::move(changes));
  return root;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::filesystem::path find_case_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::regular) return path;
  auto file = path / "case.toml";
  const bool folder = type == std::filesystem::file_type::directory;
  if (folder && is_file(file)) return file;
  const std::string message = folder ? "this folder holds no case.toml"
                              : type == std::filesystem::file_type::not_found ? "no such file or folder"
                              : error ? "cannot be read: " + error.message()
                                      : "is neither a file nor a folder";
  throw BadInput({{.place = path.string(), .message = message}});
}

std::string case_name(const std::filesystem::path& file) {
  const auto path = std::filesystem::absolute(file).lexically_normal();
  const std::string folder = path.parent_path().filename().string();
  if (path.stem() == "case") return folder.empty() ? "case" : folder;  // a case in the root folder
  return folder + "_" + path.stem().string();
}

CaseFile::CaseFile(const std::filesystem::path& path, const std::vector<std::string>& overrides)
    : content_(std::make_unique<Content>()) {
  Content& c = *content_;
  c.overrides = overrides;
  if (!path.empty()) {
    c.file = find_case_file(path);
    c.root = read_document(c.file, c.text, c.inputs);
  }
  c.start = {{1, 1}, {1, 1}, std::make_shared<const std::string>(c.file.string())};
  for (const auto& text : overrides)
    if (auto fault = apply_override(c.root, text))
      c.override_faults.emplace_back(split_path(text).front(), std::move(*fault));
}

CaseFile::~CaseFile() = default;

bool CaseFile::has(const std::string& section) const {
  return is_there(content_->root, section);
}

Kind CaseFile::kind() const {
  return kind_of(content_->root);
}

void CaseFile::visit(const std::function<void(ParameterTable&)>& description) {
  // In this order: the description shows the defaults, the used case what has been read.
  DescribeTable described;
  description(described);
  ReadTable read(&content_->root, "", "", content_->start, {folder(), content_->faults});
  description(read);
  WriteTable written;
  description(written);
  content_->sections.push_back({read.known().front(), written.text(), described.text()});
}

void CaseFile::ignore_sections(const std::vector<std::string>& sections) {
  content_->left_sections.insert(content_->left_sections.end(), sections.begin(), sections.end());
}

template <class Value>
std::optional<Value> CaseFile::value(const std::string& path) const {
  return content_->root.at_path(path).value<Value>();
}
template std::optional<bool> CaseFile::value(const std::string& path) const;
template std::optional<double> CaseFile::value(const std::string& path) const;
template std::optional<std::string> CaseFile::value(const std::string& path) const;

void CaseFile::look(const std::string& path, const std::function<void(ParameterTable&)>& description) const {
  std::vector<InputError> unsaid;
  ReadTable read(content_->root.at_path(path).as_table(), path, "", content_->start, {folder(), unsaid});
  description(read);
}

std::size_t CaseFile::count(const std::string& list) const {
  const toml::array* array = content_->root.at_path(list).as_array();
  return array ? array->size() : 0;
}

void CaseFile::fault(const std::string& key, const std::string& message) {
  content_->faults.push_back(fault_at(place_of(content_->root, key, content_->start), message));
}

void CaseFile::fault(const InputError& fault) {
  content_->faults.push_back(fault);
}

void CaseFile::throw_if_faulty() const {
  const Content& c = *content_;
  if (kind() == Kind::study)
    throw BadInput(
        {fault_at(c.root.find("study")->first.source(),
                  "this is a study, and a program computes a case; ./run.sh (installed: toryu) runs both")});
  std::vector<InputError> faults = c.faults;
  for (const auto& [section, fault] : c.override_faults)
    if (!contains(c.left_sections, section)) faults.push_back(fault);

  std::vector<std::string> known;
  for (const auto& section : c.sections) known.push_back(section.name);
  known.insert(known.end(), c.left_sections.begin(), c.left_sections.end());
  std::sort(known.begin(), known.end());  // so that all participants say the same
  for (const auto& [key, node] : c.root) {
    const std::string name(key.str());
    if (contains(known, name)) continue;
    const std::string kind = node.is_table() || node.is_array_of_tables() ? "section" : "key";
    const std::string hint = did_you_mean(name, known);
    faults.push_back(
        fault_at(key.source(), fmt::format("unknown {} '{}'{}", kind, name,
                                           hint.empty() ? "; sections are " + quoted_list(known) : hint)));
  }
  if (faults.empty()) return;
  // Faults of the file by line, then those of the overrides in their order.
  const auto rank = [&](const InputError& fault) {
    const auto is_place = [&](const std::string& text) { return override_place(text) == fault.place; };
    const auto given = std::find_if(c.overrides.begin(), c.overrides.end(), is_place);
    return std::tuple(fault.line == 0, given - c.overrides.begin(), fault.line, fault.column);
  };
  std::stable_sort(faults.begin(), faults.end(),
                   [&](const InputError& a, const InputError& b) { return rank(a) < rank(b); });
  throw BadInput(faults);
}

void CaseFile::throw_if_overrides_faulty() const {
  std::vector<InputError> faults;
  for (const auto& [section, fault] : content_->override_faults) faults.push_back(fault);
  if (!faults.empty()) throw BadInput(faults);
}

std::string CaseFile::merged() const {
  throw_if_overrides_faulty();
  std::ostringstream text;
  text << toml::toml_formatter(content_->root);
  return text.str();
}

std::string CaseFile::resolved() const {
  throw_if_overrides_faulty();
  toml::table resolved;
  const char* const kinds[] = {"study", "coupled", "fluid", "solid", "empty"};
  toml::array inputs, places;
  for (const auto& file : content_->inputs) inputs.push_back(file.string());
  add_places(content_->root, {}, places);
  resolved.insert("kind", kinds[static_cast<int>(kind())]);
  resolved.insert("file", content_->file.string());
  resolved.insert("name", name());
  resolved.insert("inputs", inputs);
  resolved.insert("content", content_->root);
  resolved.insert("places", places);
  return json_text(resolved);
}

std::string CaseFile::used() const {
  std::string text;
  for (const auto& section : content_->sections) text += section.used;
  return text;
}

std::string CaseFile::description() const {
  std::string text;
  for (const auto& section : content_->sections) text += section.description;
  return text;
}

std::uint64_t CaseFile::hash() const {
  TextHash hash;
  hash.add(content_->text);
  for (const auto& text : content_->overrides) hash.add(text);
  for (const auto& name : named_files()) {
    hash.add(name);
    hash.add(read_text(folder() / name, largest_reference));
  }
  return hash.value();
}

std::vector<std::string> CaseFile::named_files() const {
  std::set<std::string> names;
  add_named_files("", content_->root, folder(), names);
  return {names.begin(), names.end()};
}

const std::vector<std::filesystem::path>& CaseFile::inputs() const {
  return content_->inputs;
}

std::filesystem::path CaseFile::folder() const {
  if (content_->file.empty()) return {};
  return std::filesystem::absolute(content_->file).lexically_normal().parent_path();
}

std::string CaseFile::name() const {
  return case_name(content_->file);
}

}  // namespace toryu
