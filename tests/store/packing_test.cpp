// What is packed comes back bit by bit, and a database from before rows were packed loses nothing when it is updated.
#include "core/store/packing.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <csignal>

#include "core/learn/bit_coding.h"
#include "core/spec/random.h"
#include "core/store/gene_bounds.h"
#include "core/store/migrations.h"
#include "tests/store/processes.h"
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::HasSubstr;
using Mode = Database::Mode;

TEST(Packing, AChromosomeOfAnyLengthComesBack) {
  Random random(3);
  for (int length = 0; length <= 70; ++length) {
    std::string bits;
    for (int k = 0; k < length; ++k) bits += random.next() >> 63 ? '1' : '0';
    const Cell cell = packedBits(bits);
    EXPECT_EQ(bits, bitsOf(cell));
    EXPECT_EQ(length > 0 ? 1 + (static_cast<std::size_t>(length) + 7) / 8 : 0, cell.bytes.size());
  }
  for (const char* text : {"", "01x", "2", "0 1"}) EXPECT_EQ(text, bitsOf(packedBits(text)));
}

TEST(Packing, AHashIsItsBytesAndAnotherTextStaysItself) {
  const std::string hash = sha256("trace");
  EXPECT_EQ(32u, packedHash(hash).bytes.size());
  for (const std::string& text : {hash, std::string(), std::string("abc"), std::string(32, 'x'), std::string(64, 'F')})
    EXPECT_EQ(text, hashOf(packedHash(text)));
}

TEST(Packing, ParametersFollowFromTheChromosomeOrAreStoredWhole) {
  const std::vector<Parameter> genotype{
      {"a", "", "", -0.6, 0.7, 0}, {"b", "", "", 1e-3, 2.5, 1}, {"n", "", "", 1, 20, 4, {}, true}};
  std::vector<GeneBounds> genes;
  for (const Parameter& p : genotype) genes.push_back({p.minimum, p.maximum, p.integer});
  Random random(7);
  for (const auto kind : {BitCoding::Kind::binary, BitCoding::Kind::gray})
    for (const int bits : {2, 8, 17, 32}) {
      const BitCoding coding(genotype, bits, kind);
      for (int k = 0; k < 200; ++k) {
        const std::string chromosome = coding.draw(random);
        std::vector<double> parameters = coding.decode(chromosome);
        const Cell cell = packedParameters(parameters, chromosome, genes);
        EXPECT_EQ(Cell::Type::integer, cell.type);
        EXPECT_EQ(parameters, parametersOf(cell, chromosome, genes));
        parameters[1] = std::nextafter(parameters[1], 9);
        const Cell other = packedParameters(parameters, chromosome, genes);
        EXPECT_EQ(Cell::Type::blob, other.type);
        EXPECT_EQ(parameters, parametersOf(other, chromosome, genes));
      }
    }
  EXPECT_EQ((std::vector<double>{1, 2}), parametersOf(packedParameters({1, 2}, "", genes), "", genes));
  EXPECT_THAT(refusal([&] { parametersOf({Cell::Type::integer, 0, ""}, "01", {}); }), HasSubstr("damaged"));
}

TEST(Packing, BoundsOfGenesAreFoundFromWhatWasDecodedWithThem) {
  const std::vector<Parameter> genotype{
      {"a", "", "", -0.6, 0.7, 0}, {"b", "", "", 0, 0.08, 0}, {"n", "", "", 1, 20, 4, {}, true}};
  Random random(11);
  for (const auto kind : {BitCoding::Kind::binary, BitCoding::Kind::gray}) {
    const BitCoding coding(genotype, 8, kind);
    GeneBoundsFinder finder;
    for (int k = 0; k < 300; ++k) {
      const std::string chromosome = coding.draw(random);
      finder.show(chromosome, coding.decode(chromosome));
    }
    const std::vector<GeneBounds> found = finder.bounds();
    ASSERT_EQ(3u, found.size());
    EXPECT_EQ((GeneBounds{-0.6, 0.7, false}), found[0]);
    EXPECT_EQ((GeneBounds{0, 0.08, false}), found[1]);
    const std::string another = coding.draw(random);
    EXPECT_EQ(Cell::Type::integer, packedParameters(coding.decode(another), another, found).type);
  }
  GeneBoundsFinder none;
  none.show("0000000000000001", {0.3, 0.4});
  none.show("0000000100000001", {0.5, 0.7});
  EXPECT_TRUE(none.bounds().empty()) << "the same gene has become two parameters";
}

TEST(Packing, DamagedCompressedBytesAreRefused) {
  const std::string text(5000, 'x');
  const std::string packed = deflated(text);
  EXPECT_LT(packed.size(), 100u);
  EXPECT_EQ(text, inflated(packed, 5000));
  EXPECT_THAT(refusal([&] { inflated(packed, 4999); }), HasSubstr("damaged"));
  EXPECT_THAT(refusal([&] { inflated(packed, std::int64_t{1} << 40); }), HasSubstr("damaged"));
  EXPECT_THAT(refusal([&] { inflated(packed.substr(1), 5000); }), HasSubstr("damaged"));
}

/// A database as the program wrote it before rows were packed: two generations of three individuals, one of them of a
/// learner without chromosomes.
class BeforePacking : public StoreTest {
 protected:
  BeforePacking() {
    const BitCoding coding({{"a", "", "", -1, 1.9, 0}, {"b", "", "", 0, 0.5, 0}}, 8, BitCoding::Kind::binary);
    SQLite::Database raw(file(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    raw.exec("PRAGMA foreign_keys = ON");
    migrate(raw, migrations().first(6));
    raw.exec(
        "PRAGMA journal_mode = WAL; BEGIN;"
        "INSERT INTO experiment VALUES (1, 'kick', '{}', 'then', '');"
        "INSERT INTO run VALUES (1, 1, 1, '{}', 'abc', '{}', 'stand_in', '0.1.0', 'then');"
        "INSERT INTO run_state VALUES (1, 'learning', 0, 2, 0, 'then', '', '', '');"
        "INSERT INTO simulator VALUES (1, 1, 0, NULL, 'start', '', 0, 'then');"
        "INSERT INTO recording VALUES (1, 1, NULL, 'a.csv', '" +
        sha256(csv_) +
        "', '', '', 'then');"
        "INSERT INTO recording_data VALUES (1, CAST('" +
        csv_ +
        "' AS BLOB));"
        "INSERT INTO stored_file VALUES ('" +
        sha256("<robot/>") + "', CAST('<robot/>' AS BLOB)); INSERT INTO run_file VALUES (1, 0, 'leg.urdf', '" +
        sha256("<robot/>") + "');");
    Random random(5);
    SQLite::Statement row(raw,
                          "INSERT INTO individual (id, run_id, generation, slot, simulator_id, fitness, outcome, "
                          "detail, same_as, trial_seed, trace_sha256, chromosome, parameters) VALUES (?, 1, ?, ?, 1, "
                          "?, 'finished', 'falls 0', ?, 77, ?, ?, ?)");
    for (int number = 1; number <= 2; ++number) {
      const std::string n = std::to_string(number);
      raw.exec("INSERT INTO generation VALUES (1, " + n + ", 1, 1, 1, 1, 3, 0, 0, 0.5, 'then');" +
               "INSERT INTO learner_state VALUES (1, " + n + ", 'random " + n + "', 'learner " + n + "');" +
               "INSERT INTO adaptation VALUES (1, 1, " + n + ", 0.5, 0.75, 'r" + n + "', 'l" + n + "', 'e');" +
               "INSERT INTO adaptation_candidate VALUES (1, 1, " + n + ", 0, 0.5, '101', x'000000000000f03f')");
      for (int slot = 0; slot < 3; ++slot) {
        IndividualRecord i;
        i.id = 3 * (number - 1) + slot + 1;
        i.slot = slot;
        i.chromosome = slot < 2 ? coding.draw(random) : "";
        i.parameters = slot < 2 ? coding.decode(i.chromosome) : std::vector<double>{0.1 * number, -0.0};
        i.fitness = 0.1 * static_cast<double>(i.id);
        i.traceSha256 = slot == 1 ? "" : sha256(i.chromosome);
        i.sameAs = number == 2 && slot == 0 ? 1 : 0;
        row.reset();
        row.bind(1, i.id);
        row.bind(2, number);
        row.bind(3, slot);
        row.bind(4, i.fitness);
        if (i.sameAs != 0)
          row.bind(5, i.sameAs);
        else
          row.bind(5);
        row.bind(6, i.traceSha256);
        row.bind(7, i.chromosome);
        const std::string bytes = bytesOf(i.parameters);
        row.bind(8, static_cast<const void*>(bytes.data()), static_cast<int>(bytes.size()));
        row.exec();
        individuals_.push_back(i);
      }
    }
    raw.exec("COMMIT");
  }
  int versionOf() const {
    return SQLite::Database(file(), SQLite::OPEN_READONLY).execAndGet("PRAGMA user_version").getInt();
  }
  void expectAll(const Database& database) const {
    const std::vector<IndividualRecord> stored = database.individuals(1);
    ASSERT_EQ(individuals_.size(), stored.size());
    for (std::size_t k = 0; k < stored.size(); ++k) {
      const IndividualRecord &a = individuals_[k], &b = stored[k];
      EXPECT_EQ(a.id, b.id);
      EXPECT_EQ(a.chromosome, b.chromosome);
      ASSERT_EQ(a.parameters.size(), b.parameters.size());
      for (std::size_t p = 0; p < a.parameters.size(); ++p)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(a.parameters[p]), std::bit_cast<std::uint64_t>(b.parameters[p]));
      EXPECT_EQ(a.fitness, b.fitness);
      EXPECT_EQ(a.traceSha256, b.traceSha256);
      EXPECT_EQ(a.sameAs, b.sameAs);
      EXPECT_EQ(77u, b.trialSeed);
    }
    EXPECT_EQ("learner 2", database.lastGeneration(1)->learnerState);
    EXPECT_EQ("random 2", database.lastGeneration(1)->randomState);
    const std::vector<AdaptationRecord> adaptations = database.adaptations(1, 1);
    ASSERT_EQ(2u, adaptations.size());
    EXPECT_EQ("l2", adaptations[1].learnerState);
    EXPECT_EQ("101", adaptations[0].candidates.at(0).chromosome);
    EXPECT_EQ(csv_, database.recording(1).csv);
    EXPECT_EQ("<robot/>", database.run(1).files.at(0).content);
  }

  std::string csv_ = "time_s,leg.knee.position_rad\n0,0.5\n";
  std::vector<IndividualRecord> individuals_;
};

TEST_F(BeforePacking, EveryValueComesBackAfterTheUpdate) {
  Database database = Database::open(file(), Mode::readWrite);
  expectAll(database);
  SQLite::Database raw(file(), SQLite::OPEN_READONLY);
  EXPECT_EQ(4, raw.execAndGet("SELECT count(*) FROM individual WHERE typeof(parameters) = 'integer'").getInt());
  EXPECT_EQ(4, raw.execAndGet("SELECT count(*) FROM individual WHERE typeof(chromosome) = 'blob'").getInt());
  EXPECT_EQ(1, raw.execAndGet("SELECT count(*) FROM learner_state").getInt());
  EXPECT_EQ("ok", raw.execAndGet("PRAGMA integrity_check").getString());
}

TEST_F(BeforePacking, TheUpdatedRunGoesOnAndTakesRealitiesOfAnyName) {
  Database database = Database::open(file(), Mode::readWrite);
  GenerationRecord next = generationOf(1, 3, 4, 2);
  database.addGeneration(next);
  EXPECT_EQ("learner 3", database.lastGeneration(1)->learnerState);
  EXPECT_EQ(4u, database.individuals(1, 3).size());
  RunRecord run = runOf(1, 2);
  run.reality = "csv_folder";
  EXPECT_EQ("csv_folder", database.run(database.addRun(run, {})).reality);
}

TEST_F(BeforePacking, KilledInTheMiddleOfTheUpdateItIsTheOldFileAndIsUpdatedLater) {
  std::vector<Migration> steps(migrations().begin(), migrations().end());
  steps.push_back({"dies", [](SQLite::Database&) { raise(SIGKILL); }});
  EXPECT_EQ("DIED", inAnotherProcess([&]() -> std::string {
              SQLite::Database raw(file(), SQLite::OPEN_READWRITE);
              migrate(raw, steps);
              return "lives";
            }));
  EXPECT_EQ(6, versionOf());
  expectAll(Database::open(file(), Mode::readWrite));
}

TEST_F(BeforePacking, WithAFullDiskItStaysTheOldFileAndIsUpdatedLater) {
  const std::string answer = inAnotherProcess([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{64 * 1024, 64 * 1024};
    setrlimit(RLIMIT_FSIZE, &limit);
    return refusal([&] { Database::open(file(), Mode::readWrite); });
  });
  EXPECT_THAT(answer, HasSubstr(file() + ": disk full"));
  EXPECT_EQ(6, versionOf());
  expectAll(Database::open(file(), Mode::readWrite));
}

TEST_F(StoreTest, OfARunTheNewestStateOfItsLearnerIsKept) {
  Database database = create();
  const Id run = startRun(database);
  for (int number = 1; number <= 5; ++number) {
    GenerationRecord generation = generationOf(run, number);
    database.addGeneration(generation);
    EXPECT_EQ("learner " + std::to_string(number), database.lastGeneration(run)->learnerState);
  }
  SQLite::Database raw(file(), SQLite::OPEN_READONLY);
  EXPECT_EQ(1, raw.execAndGet("SELECT count(*) FROM learner_state").getInt());
}

TEST_F(StoreTest, AThousandIndividualsOfALongKickTakeLessThan300BytesEach) {
  Database database = create();
  std::vector<Parameter> genotype;
  RunRecord run = runOf(database.addExperiment(kickExperiment()));
  for (int k = 0; k < 25; ++k) {
    genotype.push_back({"p" + std::to_string(k), "", "", -0.1 * k, 0.7 * k + 1, 0});
    run.genes.push_back({genotype.back().minimum, genotype.back().maximum, false});
  }
  const Id id = database.addRun(run, {});
  const BitCoding coding(genotype, 8, BitCoding::Kind::binary);
  Random random(1);
  const auto pages = [&] {
    SQLite::Database raw(file(), SQLite::OPEN_READONLY);
    return raw.execAndGet("PRAGMA page_count").getInt64() * raw.execAndGet("PRAGMA page_size").getInt64();
  };
  const std::int64_t before = pages();
  constexpr int generations = 100, individuals = 30;
  for (int number = 1; number <= generations; ++number) {
    GenerationRecord g = generationOf(id, number, individuals, 25);
    for (IndividualRecord& i : g.individuals) {
      i.chromosome = coding.draw(random);
      i.parameters = coding.decode(i.chromosome);
      i.detail = "falls 0, largest_tilt_rad 0.9908, off_direction_rad 0.1022, way_m 1.457";
      i.traceSha256 = sha256(i.chromosome);
    }
    g.learnerState = std::string(6500, 'x');
    database.addGeneration(g);
  }
  EXPECT_LT(static_cast<double>(pages() - before) / (generations * individuals), 300.0);
}

}  // namespace
}  // namespace btr
